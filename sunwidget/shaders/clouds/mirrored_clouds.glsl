// The clouds mirrored by water at each place below the horizon, stretched along the line of sight and
// blurred across it. They stay where the photo has them. The map varies slowly, so a quarter of the size is enough.

#include "frame/picture.glsl"
#include "water/glint.glsl"

uniform sampler2D layers;
uniform vec2 pass_size;
uniform float wind_speed;

out vec4 result;

const int kClouds = 18;  // three by six
const float kCloudShare = 0.4;  // the steeper facets mirror the sky above them

void main() {
  vec3 view = GetViewDirection(gl_FragCoord.xy / pass_size);
  float facing = GetFacing(view, wind_speed);
  float cloud = 0.0;
  for (int i = 0; i < kClouds; ++i) {
    float higher = (float(i / 3) + 0.5) / float(kClouds / 3);
    vec3 up = normalize(vec3(view.x, mix(0.3, 1.5, higher) * facing, view.z));
    vec2 at = GetPlaceOfDirection(up).xy + vec2(0.025 * (float(i % 3) - 1.0 + 0.7 * (higher - 0.5)), 0.0);
    cloud += ReadPicture(layers, at).g / float(kClouds);
  }
  result = vec4(kCloudShare * step(view.y, 0.0) * cloud);
}
