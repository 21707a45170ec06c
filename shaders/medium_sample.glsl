// What a medium is at a place: engine/medium's Medium::at in GLSL. Put after the first line of medium_eye.frag
// and medium_light.frag (the vertex shader gets it too and uses none of it).
// Spaces: a place is relative to the sweep's anchor, metres, world axes; voxel (i, j, k) is a voxel's centre.
// Encodings: the field holds grey values as they are stored; the tables hold, three layers each, (colour,
// extinction), (indirect extinction, surface weight) and (glow, 0), extinctions in 1/m; a layer's own colours
// are square roots of linear ones, filtered as such.
// Defined by the program: FIELD, GRADIENT (its table has a second axis), LAYERS and NOISE (how many), COLORS
// (how many layers have their own), SURFACE (the gradient is wanted), GLOW, INDIRECT (indirect extinction is
// wanted).

struct Properties {
    float extinction;
    vec3 color;
    vec3 indirectExtinction;
    float surface;
    vec3 glow;
    vec3 gradient;  // value units a metre, or the nearest layer's upward normal
};
const Properties kNothing = Properties(0.0, vec3(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0));

#if GRADIENT
layout(binding = 1) uniform sampler2DArray uTables;
vec4 tableAt(vec2 at, float layer) { return textureLod(uTables, vec3(at, layer), 0.0); }
#else
layout(binding = 1) uniform sampler1DArray uTables;
vec4 tableAt(vec2 at, float layer) { return textureLod(uTables, vec2(at.x, layer), 0.0); }
#endif
uniform vec2 uPerTable;  // 1 / its columns and rows

Properties entryAt(float column, float row, float layer) {
    vec2 at = (vec2(column, row) + 0.5) * uPerTable;
    vec4 first = tableAt(at, layer);
    Properties p = Properties(first.a, first.rgb, vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
#if INDIRECT || SURFACE
    vec4 second = tableAt(at, layer + 1.0);
    p.indirectExtinction = second.rgb;
    p.surface = second.a;
#endif
#if GLOW
    p.glow = tableAt(at, layer + 2.0).rgb;
#endif
    return p;
}

#if FIELD
layout(binding = 0) uniform sampler3D uField;
uniform mat4x3 uVoxelFromPlace;
uniform vec3 uLastVoxel;          // size - 1
uniform vec3 uPerField;           // 1 / size
uniform mat3 uWorldFromGradient;  // from differences over two voxels to value units a metre
uniform vec3 uTableScale;         // columns a stored value, column of stored value 0, rows a gradient

// Beyond the faces the outermost voxels count on.
float valueAt(vec3 voxel) { return textureLod(uField, (voxel + 0.5) * uPerField, 0.0).r; }

vec3 gradientAt(vec3 voxel) {
    const vec2 e = vec2(1.0, 0.0);
    return uWorldFromGradient * vec3(valueAt(voxel + e.xyy) - valueAt(voxel - e.xyy),
                                     valueAt(voxel + e.yxy) - valueAt(voxel - e.yxy),
                                     valueAt(voxel + e.yyx) - valueAt(voxel - e.yyx));
}

Properties unperturbed(vec3 place, float footprint) {
    vec3 voxel = uVoxelFromPlace * vec4(place, 1.0);
    if (!(all(greaterThanEqual(voxel, vec3(0.0))) && all(lessThanEqual(voxel, uLastVoxel)))) return kNothing;
    vec3 gradient = vec3(0.0);
    float row = 0.0;
#if GRADIENT || SURFACE
    gradient = gradientAt(voxel);
#endif
#if GRADIENT
    row = length(gradient) * uTableScale.z;
#endif
    Properties p = entryAt(valueAt(voxel) * uTableScale.x + uTableScale.y, row, 0.0);
    p.gradient = gradient;
    return p;
}
#elif LAYERS > 0
layout(binding = 8) uniform sampler2D uHeights[LAYERS];  // mip levels side by side, metres over its lowest
uniform ivec4 uHeightLevels[LAYERS * LEVELS];            // corner and size of each
uniform vec4 uHeightFrame[LAYERS];  // samples a metre, the anchor's place in samples (u, v), coarsest level
uniform vec4 uHeightReach[LAYERS];  // below, above, 1 / taper (1e30: none), the anchor's height: metres
uniform vec2 uHeightTable[LAYERS];  // columns a metre, column of the lowest

float heightIn(int layer, int level, vec2 at) {
    ivec4 part = uHeightLevels[layer * LEVELS + level];
    vec2 inside = clamp((at + 0.5) * exp2(-float(level)) - 0.5, vec2(0.0), vec2(part.zw - 1));
    ivec2 low = ivec2(inside), high = min(low + 1, part.zw - 1);
    vec2 s = inside - vec2(low);
    float a = texelFetch(uHeights[layer], part.xy + low, 0).r;
    float b = texelFetch(uHeights[layer], part.xy + ivec2(high.x, low.y), 0).r;
    float c = texelFetch(uHeights[layer], part.xy + ivec2(low.x, high.y), 0).r;
    float d = texelFetch(uHeights[layer], part.xy + high, 0).r;
    return mix(mix(a, b, s.x), mix(c, d, s.x), s.y);
}

// In samples of the finest level; false beyond the edge.
bool overLayer(int layer, vec2 at) {
    vec2 last = vec2(uHeightLevels[layer * LEVELS].zw - 1);
    return all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, last));
}
float heightAt(int layer, vec2 at, float footprint) {
    float level = clamp(log2(max(footprint * uHeightFrame[layer].x, 1.0)), 0.0, uHeightFrame[layer].w);
    int fine = int(level);
    float height = heightIn(layer, fine, at), share = level - float(fine);
    return share > 0.0 ? mix(height, heightIn(layer, fine + 1, at), share) : height;
}

#if COLORS > 0
layout(binding = 16) uniform sampler2D uColors[COLORS];  // mip levels side by side
uniform ivec4 uColorLevels[COLORS * LEVELS];             // corner and size of each
uniform vec4 uColorFrame[COLORS];  // texel = place.xy * xy + zw
uniform vec2 uColorSize[COLORS];   // texels a metre, coarsest level
uniform int uColorOf[LAYERS];      // which of them; -1: none

vec3 rootIn(int n, int level, vec2 texel) {
    vec4 part = vec4(uColorLevels[n * LEVELS + level]);
    vec2 inside = clamp(texel * exp2(-float(level)), vec2(0.5), part.zw - 0.5);
    return textureLod(uColors[n], (part.xy + inside) / vec2(textureSize(uColors[n], 0)), 0.0).rgb;
}
// ColorTexture::at: from level to level over the middle half between them.
vec3 colorAt(int n, vec2 place, float footprint) {
    vec2 texel = place * uColorFrame[n].xy + uColorFrame[n].zw;
    float level = clamp(log2(max(footprint * uColorSize[n].x, 1.0)), 0.0, uColorSize[n].y);
    int fine = int(level);
    float share = clamp(2.0 * (level - float(fine)) - 0.5, 0.0, 1.0);
    vec3 root = rootIn(n, fine, texel);
    if (share > 0.0) root = mix(root, rootIn(n, min(fine + 1, int(uColorSize[n].y)), texel), share);
    return root * root;
}
#endif

#if SURFACE
// Slopes by the neighbours one sample away; 0 where they are not known.
float slopeAlong(int layer, vec2 at, vec2 way) {
    if (!overLayer(layer, at + way) || !overLayer(layer, at - way)) return 0.0;
    float slope = (heightIn(layer, 0, at + way) - heightIn(layer, 0, at - way)) * 0.5 * uHeightFrame[layer].x;
    return isnan(slope) ? 0.0 : slope;
}
vec3 normalOf(int layer, vec2 at) {
    return normalize(vec3(-slopeAlong(layer, at, vec2(1.0, 0.0)), -slopeAlong(layer, at, vec2(0.0, 1.0)), 1.0));
}
#endif

void addLayer(inout Properties sum, int layer, float height, vec3 place, float footprint) {
    float z = place.z + uHeightReach[layer].w;
    vec4 reach = uHeightReach[layer];
    float inside = min(z - height + reach.x, height + reach.y - z);
    if (!(inside >= 0.0)) return;
    float weight = min(inside * reach.z, 1.0);
    Properties p = entryAt(height * uHeightTable[layer].x + uHeightTable[layer].y, 0.0, float(3 * layer));
    p.extinction *= weight;
    if (!(p.extinction > 0.0)) return;
#if COLORS > 0
    if (uColorOf[layer] >= 0) p.color *= colorAt(uColorOf[layer], place.xy, footprint);
#endif
    sum.extinction += p.extinction;
    sum.indirectExtinction += weight * p.indirectExtinction;
    float share = p.extinction / sum.extinction;
    sum.color = mix(sum.color, p.color, share);
    sum.surface = mix(sum.surface, p.surface, share);
    sum.glow = mix(sum.glow, p.glow, share);
}

Properties unperturbed(vec3 place, float footprint) {
    Properties sum = kNothing;
    float least = 1e30;
    for (int layer = 0; layer < LAYERS; ++layer) {
        vec2 at = uHeightFrame[layer].yz + place.xy * uHeightFrame[layer].x;
        if (!overLayer(layer, at)) continue;
        addLayer(sum, layer, heightAt(layer, at, footprint), place, footprint);
#if SURFACE
        float away = abs(place.z + uHeightReach[layer].w - heightIn(layer, 0, at));
        if (!(away < least)) continue;
        least = away;
        sum.gradient = normalOf(layer, at);
#endif
    }
    return sum;
}
#else
Properties unperturbed(vec3 place, float footprint) { return kNothing; }
#endif

#if NOISE > 0
layout(binding = 2) uniform sampler3D uNoise;  // 32^3, repeating, -1..1
uniform vec3 uNoiseOrigin[NOISE];    // the anchor at this time, in repeats of the noise, and half a texel
uniform float uNoiseRepeats[NOISE];  // a metre
uniform float uNoiseMove[NOISE];     // metres
uniform float uNoiseExtinction[NOISE];
uniform vec3 uNoiseColor[NOISE];
uniform vec3 uNoiseIndirect[NOISE];

Properties propertiesAt(vec3 place, float footprint) {
    vec3 moved = place, color = vec3(1.0), indirect = vec3(1.0);
    float extinction = 1.0;
    for (int i = 0; i < NOISE; ++i) {
        vec4 noise = textureLod(uNoise, uNoiseOrigin[i] + place * uNoiseRepeats[i], 0.0);
        moved += uNoiseMove[i] * noise.rgb;
        extinction += uNoiseExtinction[i] * noise.a;
        color += uNoiseColor[i] * noise.r;
        indirect += uNoiseIndirect[i] * noise.g;
    }
    Properties p = unperturbed(moved, footprint);
    p.extinction *= max(extinction, 0.0);
    p.color = clamp(p.color * color, 0.0, 1.0);
    p.indirectExtinction *= max(indirect, vec3(0.0));
    return p;
}
#else
Properties propertiesAt(vec3 place, float footprint) { return unperturbed(place, footprint); }
#endif
