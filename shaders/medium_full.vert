#version 450 core
// One triangle over the viewport, which is an eye's or the light's region of the target; the scissor cuts it to
// what the slab covers. No vertex data: draw 3 vertices.
uniform float uDepth;  // -1 (nearest) .. 1, for passes that write or test depth
void main() {
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 4.0 - 1.0;
    gl_Position = vec4(corner, uDepth, 1.0);
}
