#version 330 core
// A picture that was cast a moment ago, as it is seen from where the eye is now: engine/late/late_kernel.cpp, pixel for
// pixel, but that rows do not hand their depths on. Row 0 of all textures is on top, and so is that of what is drawn.
// Out: the colour as it is packed in eyes; alpha 1 where nothing was seen before (uncovered).

uniform sampler2D uColor;    // colours of the picture that was cast
uniform sampler2D uInverse;  // 1 / metres of the same pixels; 0 is infinitely far
uniform sampler2D uPlans;    // by tile of the new picture: farthest, nearest, steps (LatePlan)
uniform ivec2 uSize;         // size of the picture that was cast
uniform ivec2 uTile;         // pixels of a tile
uniform vec3 uRows[3];       // LateMove
uniform vec3 uShift;
out vec4 color;

const float kSurfaceRise = 1.5;  // the same as in late_kernel.cpp
const float kSame = 0.03;
const int kTimes = 6;            // each leaves less than a third of the error

vec2 infinite, along;  // this pixel's place in the cast picture: for infinite depth, and its change for each 1 / metre

vec2 placeAt(float inverse) { return infinite + inverse * along; }

float inverseAt(vec2 place) {
    return texelFetch(uInverse, ivec2(clamp(place, vec2(0.0), vec2(uSize) - 0.5)), 0).r;
}

// The inverse depth that the ray meets; below 0: none, and -1 less the one before the jump.
float followed(vec3 plan) {
    float most = plan.y - plan.x, step = most / plan.z, slack = 1e-6 + 1e-3 * plan.y;
    float front = plan.y, before = plan.y, hereBefore = plan.y + step, seenBefore = plan.y;
    bool wasFront = false;
    int steps = int(plan.z);
    for (int n = 0; n <= steps; ++n) {
        float here = n == steps ? plan.x : plan.y - step * float(n);
        float seen = inverseAt(placeAt(here));
        bool behind = seen >= here;
        if (behind && (seen <= here + step + slack || (wasFront && seen - seenBefore <= kSurfaceRise * step))) {
            float met = seen;
            if (wasFront) {
                float gap = max(hereBefore - seenBefore, 0.0);
                met = hereBefore + (here - hereBefore) * (gap / max(gap + seen - here, 1e-20));
            }
            float again = inverseAt(placeAt(met));
            return abs(again - met) <= kSame * abs(met) ? again : met;
        }
        if (!behind) {
            before = wasFront ? front : here;
            front = here;
        }
        wasFront = !behind;
        hereBefore = here;
        seenBefore = seen;
    }
    return -1.0 - before;
}

// Returns the mean colour of those of the four neighbours that lie on the surface, or of all four where none does.
vec3 colorOf(vec2 place, float inverse, float reach) {
    vec2 at = clamp(place - 0.5, vec2(0.0), vec2(uSize - 1));
    ivec2 corner = min(ivec2(at), max(uSize - 2, ivec2(0)));
    vec2 part = at - vec2(corner);
    vec4 surface = vec4(0.0);
    vec3 all = vec3(0.0);
    for (int n = 0; n < 4; ++n) {
        ivec2 pixel = min(corner + ivec2(n & 1, n >> 1), uSize - 1);
        vec2 shares = mix(1.0 - part, part, vec2(n & 1, n >> 1));
        float share = shares.x * shares.y;
        vec3 seen = texelFetch(uColor, pixel, 0).rgb;
        all += share * seen;
        if (abs(texelFetch(uInverse, pixel, 0).r - inverse) <= reach) surface += share * vec4(seen, 1.0);
    }
    return surface.a > 1e-4 ? surface.rgb / surface.a : all;
}

void main() {
    vec3 here = vec3(gl_FragCoord.xy, 1.0);
    float ahead = max(dot(uRows[2], here), 1e-6);
    infinite = vec2(dot(uRows[0], here), dot(uRows[1], here)) / ahead;
    along = uShift.xy - uShift.z * infinite;
    vec3 plan = texelFetch(uPlans, ivec2(gl_FragCoord.xy) / uTile, 0).xyz;
    float inverse = 0.5 * (plan.x + plan.y), reach = 3e38;
    bool uncovered = false;
    vec2 place;
    if (plan.z <= 0.0) {
        for (int n = 0; n < (plan.z < 0.0 ? 0 : kTimes); ++n) inverse = inverseAt(placeAt(inverse));
        place = placeAt(inverse);
    } else {
        float met = followed(plan);
        uncovered = met < -0.5;
        inverse = uncovered ? -1.0 - met : met;
        place = placeAt(inverse);
        if (uncovered) inverse = inverseAt(place);
        // On a slope neighbours are further apart in depth, but not on the screen.
        reach = max(kSame * inverse + 1e-9, uncovered ? 0.0 : inversesqrt(dot(along, along)));
    }
    bool beside = any(lessThan(place, vec2(0.0))) || any(greaterThan(place, vec2(uSize)));
    color = vec4(colorOf(place, inverse, reach), uncovered || beside ? 1.0 : 0.0);
}
