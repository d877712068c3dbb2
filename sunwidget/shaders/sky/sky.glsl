// The matched sky at every pixel (sky/described_sky.glsl), for the photo's own sun: drawn once per photo.
// The frame relights by the ratio of the moved sun's sky to it, and computes the moved sun's sky itself.

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "sky/described_sky.glsl"

uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  result = vec4(GetDescribedSky(GetViewDirection(place)), 1.0);
}
