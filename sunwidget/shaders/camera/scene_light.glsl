// The photo through the inverse camera response: scene-linear light. Drawn once per photo. Alpha
// packs the other land values that the frame needs: water and the land that it mirrors, glitter and log-depth.

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "frame/packed.glsl"
#include "camera/response.glsl"

uniform sampler2D retouched;
uniform sampler2D surface;
uniform sampler2D layers;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 levels = ReadPixel(surface, place).gba;
  levels.r = PackSecond(levels.r, ReadPixel(layers, place).b);
  result = vec4(GetSceneLight(texelFetch(retouched, ivec2(gl_FragCoord.xy), 0).rgb), PackLevels(levels));
}
