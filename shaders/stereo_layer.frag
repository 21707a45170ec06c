#version 330 core
// Puts the layer of one eye over its picture, which is there. Out: colours multiplied by their alpha, to be blended.
uniform sampler2D uLayer;  // row 0 at the bottom, as the viewport has it
uniform ivec2 uCorner;     // the viewport's lower left corner in the framebuffer
out vec4 color;

void main() { color = texelFetch(uLayer, ivec2(gl_FragCoord.xy) - uCorner, 0); }
