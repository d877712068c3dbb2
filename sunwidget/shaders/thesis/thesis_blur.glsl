// S_b: the thesis' sky, blurred over an eighth of the picture (eq. 3.13).

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "thesis/reinhard.glsl"
#include "thesis/thesis_sky.glsl"

uniform sampler2D sky_view;
uniform sampler2D thesis_statistics;
uniform vec2 pass_size;

out vec4 result;

const int kReach = 3;

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 sum = vec3(0.0);
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      vec2 at = place + vec2(x, y) * (0.0625 / float(kReach));
      sum += GetThesisSky(GetMatchedSky(sky_view, GetViewDirection(at)), thesis_statistics);
    }
  }
  result = vec4(sum / float((2 * kReach + 1) * (2 * kReach + 1)), 1.0);
}
