// S̄: the thesis' sky, averaged over the picture's sky pixels. One pixel.

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "thesis/reinhard.glsl"
#include "thesis/thesis_sky.glsl"

uniform sampler2D sky_view;
uniform sampler2D layers;
uniform sampler2D thesis_statistics;

out vec4 result;

const ivec2 kGrid = ivec2(32, 24);

void main() {
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int y = 0; y < kGrid.y; ++y) {
    for (int x = 0; x < kGrid.x; ++x) {
      vec2 place = (vec2(x, y) + 0.5) / vec2(kGrid);
      float weight = ReadBilinear(layers, place).r + 1e-6;
      sum += weight * GetThesisSky(GetMatchedSky(sky_view, GetViewDirection(place)), thesis_statistics);
      weights += weight;
    }
  }
  result = vec4(sum / weights, 1.0);
}
