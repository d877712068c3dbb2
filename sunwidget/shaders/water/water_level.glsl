// The light of the water without the old sun's glints, slowly varying: the mean of the logarithms of
// the water about as far away, that is in the same rows, where the photo does not glitter. Of one size
// for all pictures, so that a large one has the preview's water; drawn once a photo.

#include "frame/picture.glsl"
#include "camera/response.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kAcross = 32;  // samples either side, over the whole width
const int kRows = 5;

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int row = 0; row < kRows; ++row) {
    // Rows farther off stand in where all of the nearer ones glitters.
    float away = float(row - kRows / 2);
    float down = sign(away) * (abs(away) < 1.5 ? 0.5 / pass_size.y : 0.03);
    float row_weight = abs(away) < 1.5 ? 1.0 : 0.01;
    for (int i = -kAcross; i <= kAcross; ++i) {
      float across = float(i) / float(kAcross);
      vec2 at = place + vec2(across, down);
      float inside = step(0.0, at.x) * step(at.x, 1.0) * step(0.0, at.y) * step(at.y, 1.0);
      vec2 marks = ReadPicture(surface, at).gb;
      float weight = inside * row_weight * marks.x * (1.0 - marks.y) * (1.0 - marks.y);
      weight *= exp(-across * across / 0.05) + 1e-3;
      sum += weight * log(max(GetSceneLight(ReadPicture(photo, at).rgb), vec3(1e-5)));
      total += weight;
    }
  }
  result = vec4(exp(sum / max(total, 1e-6)), min(total, 1.0));
}
