// Mean (texel 0) and deviation (texel 1) of the model's sky in lαβ over the picture's sky.

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "thesis/reinhard.glsl"

uniform sampler2D sky_view;
uniform sampler2D layers;

out vec4 result;

const ivec2 kGrid = ivec2(96, 72);  // drawn once per photo; the gradient at the horizon needs this many

void main() {
  vec3 sum = vec3(0.0);
  vec3 squares = vec3(0.0);
  float weights = 1e-6;
  for (int y = 0; y < kGrid.y; ++y) {
    for (int x = 0; x < kGrid.x; ++x) {
      vec2 place = (vec2(x, y) + 0.5) / vec2(kGrid);
      float weight = ReadBilinear(layers, place).r + 1e-6;
      vec3 lab = GetLalphabeta(GetDisplayLight(GetMatchedSky(sky_view, GetViewDirection(place))));
      sum += weight * lab;
      squares += weight * lab * lab;
      weights += weight;
    }
  }
  vec3 mean = sum / weights;
  vec3 deviation = sqrt(max(squares / weights - mean * mean, vec3(0.0)));
  result = vec4(gl_FragCoord.x < 1.0 ? mean : deviation, 1.0);
}
