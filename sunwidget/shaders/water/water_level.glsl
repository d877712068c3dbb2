// The slowly varying light of the water without the old sun's glints: the mean logarithm of
// the water at a similar distance, that is in the same rows, where the photo does not glitter. The map has one size
// for all pictures, so that a large one has the preview's water. Drawn once per photo.

#include "frame/picture.glsl"
#include "camera/response.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kAcross = 65;  // columns read, the same for all places: otherwise a narrow dark object repeats as a comb
const int kRows = 5;
const float kOutlier = 0.4;  // natural logarithm: stumps, rocks and boats that the mask includes as water

// Weighted sum of light and, in alpha, of weights. If `level` is `known` (1, else 0) the sum is of logarithms, and
// outliers from the level count little.
vec4 GetWater(vec2 place, vec3 level, float known) {
  vec4 sum = vec4(0.0);
  for (int row = 0; row < kRows; ++row) {
    // Farther rows stand in where all nearer ones glitter.
    float away = float(row - kRows / 2);
    float down = sign(away) * (abs(away) < 1.5 ? 0.5 / pass_size.y : 0.03);
    float row_weight = abs(away) < 1.5 ? 1.0 : 0.01;
    for (int i = 0; i < kAcross; ++i) {
      vec2 at = vec2((float(i) + 0.5) / float(kAcross), place.y + down);
      float across = at.x - place.x;
      float inside = step(0.0, at.y) * step(at.y, 1.0);
      vec2 marks = ReadPicture(surface, at).gb;
      float weight = inside * row_weight * marks.x * (1.0 - marks.y) * (1.0 - marks.y);
      weight *= exp(-across * across / 0.05) + 1e-3;
      vec3 light = max(GetSceneLight(ReadPicture(photo, at).rgb), vec3(1e-5));
      float deviation = known * length(log(light / level)) / kOutlier;
      weight /= 1.0 + deviation * deviation * deviation * deviation;
      sum += weight * vec4(mix(light, log(light), known), 1.0);
    }
  }
  return sum;
}

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec4 all = GetWater(place, vec3(1.0), 0.0);
  vec4 typical = GetWater(place, max(all.rgb / max(all.a, 1e-6), vec3(1e-5)), 1.0);
  result = vec4(exp(typical.rgb / max(typical.a, 1e-6)), min(all.a, 1.0));
}
