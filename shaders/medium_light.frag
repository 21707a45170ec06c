#version 450 core
// The light's pass: what a slab leaves of direct and scattered light (eq. V8 and V9 of docs/volume_light.md).
// In: the light's buffer before the slab. Out: the buffer behind it. Both hold scattered light by colour in
// rgb, linear, 1 where nothing is in the way, and direct light's share in a. Texel (x, y) of the buffer is a
// ray of the light, y downwards; a ring of texels around it stays as light sets out.
// WIDE is defined: 0 where no offset is above a texel, as rasterisers on the CPU run both sides of an `if`.
layout(binding = 4) uniform sampler2D uBefore;
uniform ivec2 uBeforeAt;    // corner of the buffer in its texture, inside the ring
uniform ivec2 uWriteAt;     // the same of what is written
uniform ivec2 uLightSize;   // texels
uniform vec3 uLightCorner;  // parallel: a place, else a direction whose length along the lamp's axis is 1
uniform vec3 uLightAcross;  // a texel on, to the right
uniform vec3 uLightDown;
uniform float uTexel;       // width of a texel: metres, of a lamp: at unit distance along its axis
uniform float uFromLamp;    // of the slab's middle along the axis of the sweep: metres
uniform float uSpread;      // offset of the taps over the root of the way through the slab: root of metres
uniform int uSlabNumber;
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

// By sweep_geometry's blurTaps for that offset, in texels.
vec3 blurred(ivec2 texel, vec3 here, float offset) {
    float square = min(offset * offset, 1e12), weight = min(square, 1.0);
    float radius = sqrt(max(square - 1.0 / 3.0, 1.0));
    vec3 sum;
#if WIDE
    if (radius > 1.0) {
        float turn = tapTurn(texel);
        vec2 centre = vec2(texel) + 0.5, arm = radius * vec2(cos(turn), sin(turn)), other = vec2(-arm.y, arm.x);
        sum = scatteredAt(centre + arm) + scatteredAt(centre - arm) + scatteredAt(centre + other) +
              scatteredAt(centre - other);
    } else
#endif
    {
        sum = texelAt(texel + ivec2(1, 0)) + texelAt(texel - ivec2(1, 0)) + texelAt(texel + ivec2(0, 1)) +
              texelAt(texel - ivec2(0, 1));
    }
    return (1.0 - weight) * here + 0.25 * weight * sum;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) - uWriteAt;
    vec2 at = vec2(texel) + 0.5;
    vec3 ray = uLightCorner + at.x * uLightAcross + at.y * uLightDown;
#if LAMP
    float k = uFromLamp / dot(uAxis, ray);  // metres along the lamp's axis
    vec3 place = uLightOrigin + k * ray, way = normalize(ray);
    float texelWidth = uTexel * k;
#else
    vec3 way = uLightForward, place = ray + (uSlab.x - dot(uAxis, ray)) / dot(uAxis, way) * way;
    float texelWidth = uTexel;
#endif
    behind = texelFetch(uBefore, uBeforeAt + texel, 0);
    if (!(dot(uAxis, way) > kLeastCosine) || !(texelWidth > 0.0)) return;
    float slabLength = uSlab.y / dot(uAxis, way);
    Properties p = propertiesAt(place, texelWidth);
    behind.a *= through(p.extinction * slabLength);
#if MODEL == 3
    behind.rgb = blurred(texel, behind.rgb, uSpread * sqrt(slabLength) / texelWidth) *
                 exp(-p.indirectExtinction * slabLength);
#endif
}
