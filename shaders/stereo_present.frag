#version 330 core
// Composes two eyes into the window, as engine/image/stereo_compose does on the CPU.
// In: eyes whose channels are square roots of linear light, 10 bits (row 0 of the texture on top).
// Out: sRGB-encoded values for a framebuffer that does not convert.

uniform sampler2D uFirst;    // the eye that comes first; of one eye, that one; in anaglyphs the left
uniform sampler2D uSecond;   // the other one
uniform sampler1D uEncoded;  // 1024 values: sRGB encoding of a 10-bit channel
uniform ivec2 uEyeSize;      // pixels of one eye
uniform ivec2 uComposed;     // pixels of the composed picture
uniform ivec4 uViewport;     // x, y (from the bottom), width, height in the framebuffer
uniform ivec2 uTurn;         // added to the place in the viewport where eyes take turns
uniform int uLayout;         // 0 one eye, 1 side by side, 2 top-bottom, 3 rows, 4 columns, 5 checkerboard, 6 anaglyph
uniform bool uHalf;          // eyes squeezed along the layout's axis
uniform mat3 uFromFirst;     // anaglyph: weights of the first eye's channels
uniform mat3 uFromSecond;
uniform bool uLinear;        // anaglyph in linear light
out vec4 color;

float encodedChannel(float root) { return texelFetch(uEncoded, int(clamp(root, 0.0, 1.0) * 1023.0 + 0.5), 0).r; }
vec3 encoded(vec3 root) { return vec3(encodedChannel(root.r), encodedChannel(root.g), encodedChannel(root.b)); }

vec3 eye(bool second, ivec2 p) {
    p = clamp(p, ivec2(0), uEyeSize - 1);
    return second ? texelFetch(uSecond, p, 0).rgb : texelFetch(uFirst, p, 0).rgb;
}

// Two neighbours of a squeezed eye, averaged in linear light.
vec3 pairOf(bool second, ivec2 p, ivec2 axis) {
    vec3 a = eye(second, p), b = eye(second, p + axis);
    return sqrt(0.5 * (a * a + b * b));
}

vec3 split(ivec2 p, ivec2 axis) {
    int along = axis.x == 1 ? p.x : p.y;
    int perEye = (axis.x == 1 ? uComposed.x : uComposed.y) / 2;
    bool second = along >= perEye;
    if (second) p -= axis * perEye;
    return uHalf ? pairOf(second, p + axis * (axis.x == 1 ? p.x : p.y), axis) : eye(second, p);
}

vec3 anaglyph(ivec2 p) {
    vec3 a = eye(false, p), b = eye(true, p);
    if (!uLinear) return uFromFirst * encoded(a) + uFromSecond * encoded(b);
    return encoded(sqrt(clamp(uFromFirst * (a * a) + uFromSecond * (b * b), 0.0, 1.0)));
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy) - uViewport.xy;
    place.y = uViewport.w - 1 - place.y;
    // The nearest pixel of the composed picture: itself where the sizes agree.
    ivec2 p = ((2 * place + 1) * uComposed) / (2 * uViewport.zw);
    ivec2 turn = place + uTurn;
    vec3 value;
    if (uLayout == 1) value = encoded(split(p, ivec2(1, 0)));
    else if (uLayout == 2) value = encoded(split(p, ivec2(0, 1)));
    else if (uLayout == 3) value = encoded(eye((turn.y & 1) == 1, p));
    else if (uLayout == 4) value = encoded(eye((turn.x & 1) == 1, p));
    else if (uLayout == 5) value = encoded(eye(((turn.x + turn.y) & 1) == 1, p));
    else if (uLayout == 6) value = anaglyph(p);
    else value = encoded(eye(false, p));
    color = vec4(clamp(value, 0.0, 1.0), 1.0);
}
