// The light of the water without the old sun's glints, slowly varying: the mean of the logarithms of
// the water about as far away, that is in the same rows, where the photo does not glitter. Of one size
// for all pictures, so that a large one has the preview's water; drawn once a photo.

#include "frame/picture.glsl"
#include "camera/response.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kAcross = 65;  // columns that are read, the same for all places: a narrow dark thing would else repeat as a comb
const int kRows = 5;
const float kUnlike = 0.4;  // of the natural logarithm: stumps, rocks and boats that the mask calls water

// Sum of light and, in alpha, of weights; of logarithms of light where some level is `known`, 0 or 1: what is unlike that
// counts little.
vec4 GetWater(vec2 place, vec3 level, float known) {
  vec4 sum = vec4(0.0);
  for (int row = 0; row < kRows; ++row) {
    // Rows farther off stand in where all of the nearer ones glitters.
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
      float unlike = known * length(log(light / level)) / kUnlike;
      weight /= 1.0 + unlike * unlike * unlike * unlike;
      sum += weight * vec4(mix(light, log(light), known), 1.0);
    }
  }
  return sum;
}

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec4 all = GetWater(place, vec3(1.0), 0.0);
  vec4 alike = GetWater(place, max(all.rgb / max(all.a, 1e-6), vec3(1e-5)), 1.0);
  result = vec4(exp(alike.rgb / max(alike.a, 1e-6)), min(all.a, 1.0));
}
