// The photo through the inverse camera response: scene-linear light. Drawn once a photo.

#include "lib/picture.glsl"
#include "lib/response.glsl"

uniform sampler2D photo;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  result = vec4(GetSceneLight(ReadPicture(photo, place).rgb), 1.0);
}
