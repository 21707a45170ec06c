#version 450 core
// An eye's pass: what a slab sends to it and how much of what lies behind is seen through it (eq. V3 to V7 of
// docs/volume_light.md).
// In: the light's buffer before the slab, as medium_light.frag leaves it. Out: linear light in rgb and the
// share seen through in a, for blending (forward: behind what is there, backward: before it); the view depth
// of the slab's sample in metres, of which the least is kept. Pixel (x, y) of an eye, y downwards.
// Defined by the program, beside what the files before it need: PHASE, EYES, BAKED, BEYOND, OPENNESS, LEAST_KNOWN.
uniform int uEye;
uniform ivec2 uEyeAt;           // corner of its region in the target
uniform vec3 uEyeOrigin[EYES];
uniform vec3 uEyeCorner[EYES];  // ray through the region's corner, of length 1 along the view axis, as all rays
uniform vec3 uEyeAcross[EYES];  // step of the ray from a pixel to the next on its right
uniform vec3 uEyeDown[EYES];    // the same for the next below
uniform float uEyePixel[EYES];  // width of a pixel at unit depth
uniform float uFromEye;         // place of the slab's middle along the axis of the sweep: metres
layout(binding = 4) uniform sampler2D uBefore;
uniform ivec2 uBeforeAt;
uniform ivec2 uLightSize;
uniform mat4x3 uLightFromPlace;  // to (x w, y w, w), x and y in texels
layout(binding = 3) uniform sampler1D uPhase;  // by half the angle, see PhaseTexture
uniform vec2 uPhaseScale;
uniform float uIndirectShare;
uniform vec4 uShading;  // ambient, diffuse, specular, shininess
#if BAKED
layout(binding = 5) uniform sampler3D uBaked;  // linear light times weight, and the weight
uniform mat4x3 uBakedFromPlace;                // to texture coordinates
uniform vec2 uBakedShares;                     // x: exposure of baked light; y: share of lamp shading added to it
#if BEYOND
layout(binding = 6) uniform sampler3D uBeyond;  // linear light where uBaked's texels are not known; known everywhere
uniform mat4x3 uBeyondFromPlace;
#endif
#endif
layout(location = 0) out vec4 sent;
layout(location = 1) out float viewDepth;

// Scattered light in rgb, direct in a; outside the buffer what the ring around it holds.
vec4 lightBefore(vec3 place) {
    vec3 h = uLightFromPlace * vec4(place, 1.0);
    if (!(h.z > 0.0)) return vec4(0.0);
    vec2 at = clamp(h.xy / h.z, vec2(-0.5), vec2(uLightSize) + 0.5);
    return textureLod(uBefore, (vec2(uBeforeAt) + at) / vec2(textureSize(uBefore, 0)), 0.0);
}

vec3 phase(float cosine) {
    float sine = sqrt(max(0.5 - 0.5 * abs(cosine), 0.0));
    float at = cosine >= 0.0 ? sine : 1.41421356 - sine;
    return textureLod(uPhase, at * uPhaseScale.x + uPhaseScale.y, 0.0).rgb;
}

// Blinn-Phong with the gradient as normal, of both sides alike; the highlight where eye and light are on the
// same side.
float shading(vec3 gradient, vec3 way, vec3 view) {
    float square = dot(gradient, gradient);
    if (!(square > 0.0)) return 0.0;
    vec3 normal = gradient * inversesqrt(square), middle = way + view;
    float toLight = dot(normal, way), toEye = dot(normal, view), long2 = dot(middle, middle);
    float sum = uShading.x + uShading.y * abs(toLight);
    float shine = abs(dot(normal, middle)) * inversesqrt(max(long2, 1e-30));
    // pow() is affordable: few places have a surface weight. Exponents need not be whole numbers.
    return toLight * toEye > 0.0 && long2 > 0.0 ? sum + uShading.z * pow(clamp(shine, 1e-30, 1.0), uShading.w) : sum;
}

// f_s of V3.
vec3 surfaceLight(Properties p, vec3 place, vec3 way, vec3 view) {
    vec3 shaded = vec3(shading(p.gradient, way, view));
#if BAKED
    vec4 sum = textureLod(uBaked, uBakedFromPlace * vec4(place, 1.0), 0.0);
    // Texels are at most 65504 times their weight: finite.
    vec3 known = sum.rgb / max(sum.a, LEAST_KNOWN);
#if BEYOND
    if (sum.a < 1.0) {
        vec3 far = textureLod(uBeyond, uBeyondFromPlace * vec4(place, 1.0), 0.0).rgb;
        known = sum.a < LEAST_KNOWN ? far : mix(far, known, sum.a);
    }
#else
    if (sum.a < LEAST_KNOWN) return shaded;
#endif
#if OPENNESS
    return shaded * known.r;
#else
    return known * uBakedShares.x + uBakedShares.y * shaded;
#endif
#else
    return shaded;
#endif
}

// Light that the slab sends on from the light's way to the eye's; x: its optical depth along the eye's ray.
vec3 scattered(Properties p, vec3 place, vec3 view, float x) {
#if MODEL == 0
    return p.color * share(x, 0.0);
#else
    Arriving light = arrivingAt(place);
    vec3 color = p.color * light.radiance;
#if SURFACE
    if (p.surface > 0.0) color *= 1.0 - p.surface + p.surface * surfaceLight(p, place, light.way, view);
#endif
#if MODEL == 1
    return color * share(x, 0.0);
#else
    vec4 before = lightBefore(place);
    vec3 received = vec3(light.direct * before.a * share(x, min(p.extinction * light.slabLength, 1e30)));
#if PHASE
    received *= phase(-dot(light.way, view));
#endif
#if MODEL == 3
    received += uIndirectShare * before.rgb * share(x, min(p.indirectExtinction * light.slabLength, 1e30));
#endif
    return color * received;
#endif
#endif
}

void main() {
    vec2 pixel = gl_FragCoord.xy - vec2(uEyeAt);
    vec3 ray = uEyeCorner[uEye] + pixel.x * uEyeAcross[uEye] + pixel.y * uEyeDown[uEye];
    float along = dot(uAxis, ray), k = uFromEye / along, far = length(ray);
    float cosine = (FORWARD != 0 ? along : -along) / far;
    if (!(k > 0.0) || !(cosine > kLeastCosine)) discard;
    vec3 place = uEyeOrigin[uEye] + k * ray;
    Properties p = propertiesAt(place, uEyePixel[uEye] * k);
    if (!(p.extinction > 0.0)) discard;
    float x = min(p.extinction * uSlab.y / cosine, 1e30);
    sent = vec4(scattered(p, place, ray / far, x), through(x));
#if GLOW
    sent.rgb += p.glow * (1.0 - sent.a);
#endif
    viewDepth = k;
}
