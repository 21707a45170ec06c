#version 450 core
// Marks rays that have ended: writes the nearest depth where less than 1/1024 of the background is left, so that the
// depth test keeps later slabs from them. Runs every few slabs of a forward sweep; no colour is written.
layout(binding = 4) uniform sampler2D uEyes;  // the target of the eyes itself: light in rgb, the share of the background in a
void main() {
    if (texelFetch(uEyes, ivec2(gl_FragCoord.xy), 0).a >= 1.0 / 1024.0) discard;
}
