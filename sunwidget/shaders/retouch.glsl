// The photo with its clouds changed under its own sun, display-linear; alpha is the clouds' opacity
// afterwards. What follows takes it for the photo, so that a moved sun costs the same with other
// clouds as with the photo's own.

#include "lib/picture.glsl"
#include "lib/cloud_opacity.glsl"

uniform sampler2D photo;
uniform sampler2D layers;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec4 layer = ReadPicture(layers, place);
  float opacity = EditOpacity(layer.g, layer.r, ReadBilinear(clear_sky, place).a);
  result = vec4(ReadPicture(photo, place).rgb, opacity);
}
