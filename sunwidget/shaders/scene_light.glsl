// The photo through the inverse camera response: scene-linear light. Drawn once a photo. Alpha
// carries what else the frame asks about the land of a pixel: water and glitter.

#include "lib/picture.glsl"
#include "lib/packed.glsl"
#include "lib/response.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 levels = vec3(ReadPicture(surface, place).gb, 0.0);
  result = vec4(GetSceneLight(ReadPicture(photo, place).rgb), PackLevels(levels));
}
