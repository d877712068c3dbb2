// The model's clear sky at every pixel, scaled to the photo's scene-linear unit.
// Drawn twice, at the photo's own sun and at the moved one; their quotient relights the sky.

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"

uniform sampler2D sky_view;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  result = vec4(GetMatchedSky(sky_view, GetViewDirection(place)), 1.0);
}
