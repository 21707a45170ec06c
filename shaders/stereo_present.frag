#version 330 core
// Composes two eyes into the window, as engine/image/stereo_compose does on the CPU.
// In: eyes whose channels are square roots of linear light, 10 bits (row 0 of the texture on top).
// Out: sRGB-encoded values for a framebuffer that does not convert.
// LAYOUT is defined when it is compiled, one program each: a rasteriser on the CPU runs all branches of
// an `if`, even where the condition is the same for all pixels.
//   0 one eye, 1 one eye squeezed to half its width, 2 to half its height,
//   3 rows, 4 columns, 5 checkerboard, 6 anaglyph
// OVER is defined where a layer lies over each eye.

uniform sampler2D uFirst;    // the eye that comes first, or the only one; in anaglyphs the left
uniform sampler2D uSecond;   // the other one
uniform sampler1D uEncoded;  // 1024 values: sRGB encoding of a 10-bit channel
uniform ivec2 uEyeSize;      // pixels of one eye
uniform ivec4 uViewport;     // x, y (from the bottom), width, height in the framebuffer
uniform vec2 uScale;         // pixels of the picture for one of the viewport: 1 where the sizes agree
uniform ivec2 uTurn;         // added to the place in the viewport where eyes take turns
uniform mat3 uFromFirst;     // anaglyph: weights of the first eye's channels
uniform mat3 uFromSecond;
uniform bool uLinear;        // anaglyph in linear light
out vec4 color;

float encodedChannel(float root) { return texelFetch(uEncoded, int(root * 1023.0 + 0.5), 0).r; }
vec3 encoded(vec3 root) { return vec3(encodedChannel(root.r), encodedChannel(root.g), encodedChannel(root.b)); }

#ifdef OVER
// Colours multiplied by their alpha, row 0 at the bottom. They are sRGB-encoded, which stands in for roots here: black
// and white are the same, greys differ by less than 0.04.
uniform sampler2D uFirstLayer, uSecondLayer;

vec3 eyeAt(sampler2D eye, sampler2D layer, ivec2 p) {
    vec4 over = texelFetch(layer, ivec2(p.x, uEyeSize.y - 1 - p.y), 0);
    return texelFetch(eye, p, 0).rgb * (1.0 - over.a) + over.rgb;
}
vec3 firstEye(ivec2 p) { return eyeAt(uFirst, uFirstLayer, min(p, uEyeSize - 1)); }
vec3 secondEye(ivec2 p) { return eyeAt(uSecond, uSecondLayer, min(p, uEyeSize - 1)); }
#else
vec3 firstEye(ivec2 p) { return texelFetch(uFirst, min(p, uEyeSize - 1), 0).rgb; }
vec3 secondEye(ivec2 p) { return texelFetch(uSecond, min(p, uEyeSize - 1), 0).rgb; }
#endif

#if LAYOUT == 0
vec3 picture(ivec2 p, ivec2 turn) { return encoded(firstEye(p)); }
#elif LAYOUT == 1 || LAYOUT == 2
// Two neighbours, averaged in linear light.
vec3 picture(ivec2 p, ivec2 turn) {
    ivec2 axis = LAYOUT == 1 ? ivec2(1, 0) : ivec2(0, 1);
    p += p * axis;
    vec3 a = firstEye(p), b = firstEye(p + axis);
    return encoded(sqrt(0.5 * (a * a + b * b)));
}
#elif LAYOUT == 6
vec3 picture(ivec2 p, ivec2 turn) {
    vec3 a = firstEye(p), b = secondEye(p);
    if (!uLinear) return uFromFirst * encoded(a) + uFromSecond * encoded(b);
    return encoded(sqrt(clamp(uFromFirst * (a * a) + uFromSecond * (b * b), 0.0, 1.0)));
}
#else
vec3 picture(ivec2 p, ivec2 turn) {
    int count = LAYOUT == 3 ? turn.y : LAYOUT == 4 ? turn.x : turn.x + turn.y;
    return encoded((count & 1) == 1 ? secondEye(p) : firstEye(p));
}
#endif

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy) - uViewport.xy;
    place.y = uViewport.w - 1 - place.y;
    // The nearest pixel of the picture.
    ivec2 p = ivec2((vec2(place) + 0.5) * uScale);
    color = vec4(clamp(picture(p, place + uTurn), 0.0, 1.0), 1.0);
}
