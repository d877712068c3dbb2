// The slowly varying light of the water without the old sun's glints: the mean logarithm of
// the water at a similar distance, that is in the same rows, where the photo does not glitter, relative to the sky
// that it mirrors. Alpha: the height of its waves, natural logarithm, 0 without such water. The map has one size for
// all pictures, so that a large one has the preview's water. Drawn once per photo.

#include "frame/picture.glsl"
#include "camera/response.glsl"
#include "water/waves.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform sampler2D mirror_source;
uniform vec2 pass_size;

out vec4 result;

const int kAcross = 65;  // columns read, the same for all places: otherwise a narrow dark object repeats as a comb
const int kRows = 5;
const float kOutlier = 0.4;  // natural logarithm: stumps, rocks and boats that the mask includes as water

// Log of the sky that the water mirrors by the model, brighter under the sun.
vec3 GetMirrored(vec2 place) {
  return log(max(ReadBilinear(mirror_source, place).rgb, vec3(1e-6)));
}

// Mean light relative to the mirrored sky, and in alpha the weight. If `level` (log) is `known` (1, else 0) it is the
// mean log, and outliers from the level count little; `waves` is the mean deviation from it.
vec4 GetWater(vec2 place, vec3 level, float known, out float waves) {
  waves = 0.0;
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
      // By the inverse square of the distance (Shepard 1968) beyond 2 % of the width, with a share for all.
      weight *= 10.0 + 1.0 / (across * across + 4e-4);
      vec3 light = log(max(GetSceneLight(ReadPicture(photo, at).rgb), vec3(1e-5))) - GetMirrored(at);
      float deviation = known * length(light - level);
      weight /= 1.0 + pow(deviation / kOutlier, 4.0);
      waves += weight * deviation;
      sum += weight * vec4(mix(exp(light), light, known), 1.0);
    }
  }
  float total = max(sum.a, 1e-6);
  waves /= total;
  return vec4(sum.rgb / total, sum.a);
}

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  float waves;
  vec4 all = GetWater(place, vec3(0.0), 0.0, waves);
  vec4 typical = GetWater(place, log(max(all.rgb, vec3(1e-5))), 1.0, waves);
  result = vec4(exp(typical.rgb + GetMirrored(place)), smoothstep(0.0, 0.01, all.a) * max(waves, kLowestWave));
}
