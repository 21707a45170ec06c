// How a slab weakens and sends light: eq. V5 to V7 of docs/volume_light.md. Put before medium_eye.frag and
// medium_light.frag, behind medium_sample.glsl.
// Spaces: places relative to the sweep's anchor, metres, world axes.
// Defined by the program: FORWARD, LAMP, MODEL (0 emission, 1 surface, 2 direct, 3 indirect).

const float kLeastCosine = 1e-4;  // sweep_geometry's

uniform vec3 uAxis;
uniform vec2 uSlab;          // t of its middle, and its thickness: metres
uniform vec3 uLightOrigin;   // place of a lamp
uniform vec3 uLightForward;  // unit
uniform float uLightStart;   // t before which a lamp lights nothing
uniform float uLampCosine;   // cosine of half a lamp's cone
uniform float uPerFalloff;   // 1 / metres, 0 without
uniform vec3 uRadiance;      // linear

// (1 - exp(-z)) / z: by its series where the difference would lose digits.
float meanSeries(float z) { return 1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0))); }
vec3 meanSeries(vec3 z) { return 1.0 - z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0))); }
float meanShare(float z) { return z < 0.05 ? meanSeries(z) : (1.0 - exp(-z)) / max(z, 0.05); }
vec3 meanShare(vec3 z) {
    return mix((1.0 - exp(-z)) / max(z, 0.05), meanSeries(z), lessThan(z, vec3(0.05)));
}

// exp(-z). llvmpipe's is below 1 for tiny z, which hundreds of slabs add up.
float through(float z) { return z < 0.05 ? 1.0 - z * meanSeries(z) : exp(-z); }

// slabShare: of optical depths of the slab along the eye's ray and the light's, up to 1e30 each.
#if FORWARD
float share(float x, float y) { return x * meanShare(x + y); }
vec3 share(float x, vec3 y) { return x * meanShare(x + y); }
#else
float share(float x, float y) { return x * exp(-min(x, y)) * meanShare(abs(x - y)); }
vec3 share(float x, vec3 y) { return x * exp(-min(vec3(x), y)) * meanShare(abs(x - y)); }
#endif

struct Arriving {
    vec3 way;          // that it travels, unit
    vec3 radiance;     // R of V4: 0 where nothing arrives
    float direct;      // 0 beside a lamp's cone, where scattered light alone arrives; else 1
    float slabLength;  // length of the slab along its way: metres
};
Arriving arrivingAt(vec3 place) {
#if LAMP
    vec3 from = place - uLightOrigin, fallen = from * uPerFalloff;
    vec3 way = from * inversesqrt(max(dot(from, from), 1e-30));
    float across = dot(uAxis, way);
    float ahead = dot(way, uLightForward);
    bool lit = uSlab.x > uLightStart && ahead > 0.0 && across > kLeastCosine, inCone = ahead >= uLampCosine;
#if MODEL != 3
    lit = lit && inCone;
#endif
    vec3 radiance = lit ? uRadiance / (1.0 + dot(fallen, fallen)) : vec3(0.0);
    return Arriving(way, radiance, inCone ? 1.0 : 0.0, lit ? uSlab.y / across : 0.0);
#else
    return Arriving(uLightForward, uRadiance, 1.0, uSlab.y / dot(uAxis, uLightForward));
#endif
}
