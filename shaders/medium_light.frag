#version 450 core
// The light's pass: what a slab leaves of direct and scattered light (eq. V8 and V9 of docs/volume_light.md).
// Where slabs lean against the light's way, taps count by V11.
// In: the light's buffer before the slab. Out: the buffer behind it. Both hold scattered light by colour in
// rgb, linear, 1 where nothing is in the way, and direct light's share in a. Texel (x, y) of the buffer is a
// ray of the light, y downwards; a ring of texels around it stays as light sets out.
// WIDE is defined: 0 where no offset is above a texel, as rasterisers on the CPU run both sides of an `if`. So is
// LEANS: 0 where V11 does not count.
layout(binding = 4) uniform sampler2D uBefore;
uniform ivec2 uBeforeAt;    // corner of the buffer in its texture, inside the ring
uniform ivec2 uWriteAt;     // corner of what is written, in its texture
uniform ivec2 uLightSize;   // texels
uniform vec3 uLightCorner;  // parallel: a place, else a direction whose length along the lamp's axis is 1
uniform vec3 uLightAcross;  // a texel on, to the right
uniform vec3 uLightDown;
uniform float uTexel;       // width of a texel: metres, of a lamp: at unit distance along its axis
uniform float uFromLamp;    // place of the slab's middle along the axis of the sweep: metres
uniform float uSpread;      // offset of the taps over the root of the way through the slab: root of metres
uniform int uSlabNumber;
uniform float uLeaning;     // how far V11 counts, 0..1
layout(location = 0) out vec4 behind;

vec3 texelAt(ivec2 texel) { return texelFetch(uBefore, uBeforeAt + texel, 0).rgb; }

vec3 scatteredAt(vec2 at) {  // bilinear; continuous coordinates, centres at halves
    vec2 inside = clamp(at, vec2(-0.5), vec2(uLightSize) + 0.5);
    return textureLod(uBefore, (vec2(uBeforeAt) + inside) / vec2(textureSize(uBefore, 0)), 0.0).rgb;
}

// sweep_geometry's tapTurn.
float tapTurn(ivec2 texel) {
    uint h = uint(texel.x) * 0x8da6b343u ^ uint(texel.y) * 0xd8163841u ^ uint(uSlabNumber) * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    h ^= h >> 16;
    return float(h >> 8) * (1.57079632679 / 16777216.0);
}

// Where a texel's ray crosses the middle of the slab.
struct Crossing {
    vec3 place, way;
    float width;  // width of a texel there: metres; 0 or less: behind a lamp
    vec2 lags;    // sweep_geometry's tapLags
};
Crossing crossingOf(ivec2 texel) {
    vec2 at = vec2(texel) + 0.5;
    vec3 ray = uLightCorner + at.x * uLightAcross + at.y * uLightDown;
    vec2 leans = vec2(dot(uAxis, uLightAcross), dot(uAxis, uLightDown));
    Crossing c;
#if LAMP
    float along = dot(uAxis, ray), k = uFromLamp / along, far = length(ray);  // k: metres along the lamp's axis
    c.place = uLightOrigin + k * ray;
    c.way = ray / far;
    c.width = uTexel * k;
    c.lags = uLeaning * k * (vec2(dot(ray, uLightAcross), dot(ray, uLightDown)) / far - far / along * leans);
#else
    c.way = uLightForward;
    c.place = ray + (uSlab.x - dot(uAxis, ray)) / dot(uAxis, c.way) * c.way;
    c.width = uTexel;
    c.lags = -uLeaning / dot(uAxis, c.way) * leans;
#endif
    return c;
}
bool crosses(Crossing c) { return dot(uAxis, c.way) > kLeastCosine && c.width > 0.0; }

#if LEANS
// V11: a tap whose ray is met later has lost more of its light on the way. at: of the tap, in texels.
vec3 leveled(vec3 light, vec2 at, float later) {
    ivec2 texel = ivec2(floor(clamp(at, vec2(-1.0), vec2(uLightSize))));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, uLightSize))) return light;
    Crossing c = crossingOf(texel);
    if (!crosses(c)) return light;
    return light * (1.0 + clamp(propertiesAt(c.place, c.width).indirectExtinction * later, -1.0, 1.0));
}
#else
vec3 leveled(vec3 light, vec2 at, float later) { return light; }
#endif
vec3 nearTap(ivec2 texel, ivec2 by, vec2 lags) {
    return leveled(texelAt(texel + by), vec2(texel + by) + 0.5, dot(vec2(by), lags));
}
vec3 farTap(vec2 centre, vec2 by, vec2 lags) { return leveled(scatteredAt(centre + by), centre + by, dot(by, lags)); }

// By sweep_geometry's blurTaps for that offset, in texels.
vec3 blurred(ivec2 texel, vec3 here, float offset, vec2 lags) {
    float square = min(offset * offset, 1e12), weight = min(square, 1.0);
    float radius = sqrt(max(square - 1.0 / 3.0, 1.0));
    vec3 sum;
#if WIDE
    if (radius > 1.0) {
        float turn = tapTurn(texel);
        vec2 centre = vec2(texel) + 0.5, arm = radius * vec2(cos(turn), sin(turn)), other = vec2(-arm.y, arm.x);
        sum = farTap(centre, arm, lags) + farTap(centre, -arm, lags) + farTap(centre, other, lags) +
              farTap(centre, -other, lags);
    } else
#endif
    {
        sum = nearTap(texel, ivec2(1, 0), lags) + nearTap(texel, ivec2(-1, 0), lags) +
              nearTap(texel, ivec2(0, 1), lags) + nearTap(texel, ivec2(0, -1), lags);
    }
    return min((1.0 - weight) * here + 0.25 * weight * sum, 1.0);
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) - uWriteAt;
    Crossing at = crossingOf(texel);
    behind = texelFetch(uBefore, uBeforeAt + texel, 0);
    if (!crosses(at)) return;
    float slabLength = uSlab.y / dot(uAxis, at.way);
    Properties p = propertiesAt(at.place, at.width);
    behind.a *= through(p.extinction * slabLength);
#if MODEL == 3
    behind.rgb = blurred(texel, behind.rgb, uSpread * sqrt(slabLength) / at.width, at.lags) *
                 exp(-p.indirectExtinction * slabLength);
#endif
}
