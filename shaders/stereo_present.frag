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
uniform ivec2 uEyeSize;      // pixels of one eye
uniform ivec4 uViewport;     // x, y (from the bottom), width, height in the framebuffer
uniform vec2 uScale;         // pixels of the picture for one of the viewport: 1 where the sizes agree
uniform ivec2 uTurn;         // added to the place in the viewport where eyes take turns
uniform mat3 uFromFirst;     // anaglyph: weights of the first eye's channels
uniform mat3 uFromSecond;
uniform bool uLinear;        // anaglyph in linear light
out vec4 color;

// sRGB (IEC 61966-2-1) of x * x: 12.92 x^2 up to the square root of 0.0031308, then 1.055 x^(5/6) - 0.055, for which
// stands the cubic in sqrt(x) with the least largest error over all 10-bit values: 0.055 of 1/255.
vec3 encoded(vec3 x) {
    vec3 t = sqrt(x);
    vec3 curve = ((-0.13648860 * t + 0.95189810) * t + 0.25622119) * t - 0.07184255;
    return mix(curve, 12.92 * x * x, vec3(lessThan(x, vec3(0.055954))));
}

// The middle of a texel, so that no rounding picks its neighbour; beside the picture its border. In llvmpipe this
// takes half the time of texelFetch.
vec3 texel(sampler2D eye, ivec2 p) { return textureLod(eye, (vec2(p) + 0.5) / vec2(uEyeSize), 0.0).rgb; }

#ifdef OVER
// Colours multiplied by their alpha, row 0 at the bottom. They are sRGB-encoded, which stands in for roots here: black
// and white are the same, greys differ by less than 0.04.
uniform sampler2D uFirstLayer, uSecondLayer;

vec3 eyeAt(sampler2D eye, sampler2D layer, ivec2 p) {
    vec4 over = texelFetch(layer, ivec2(p.x, uEyeSize.y - 1 - p.y), 0);
    return texel(eye, p) * (1.0 - over.a) + over.rgb;
}
vec3 firstEye(ivec2 p) { return eyeAt(uFirst, uFirstLayer, min(p, uEyeSize - 1)); }
vec3 secondEye(ivec2 p) { return eyeAt(uSecond, uSecondLayer, min(p, uEyeSize - 1)); }
#else
vec3 firstEye(ivec2 p) { return texel(uFirst, p); }
vec3 secondEye(ivec2 p) { return texel(uSecond, p); }
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
