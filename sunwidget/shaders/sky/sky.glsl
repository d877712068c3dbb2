// The matched sky at every pixel (sky/described_sky.glsl). Of the photo's own sun it is drawn once
// a photo; the frame relights by what the sky at the moved sun is to it, and draws that itself.

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "sky/described_sky.glsl"

uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  result = vec4(GetDescribedSky(GetViewDirection(place)), 1.0);
}
