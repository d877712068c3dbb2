// The sky's scene-linear light with its clouds' edges dissolved: the photo, blurred within the sky as
// widely as the opacity in clear_sky's alpha (analysis/clear_sky.py).

#include "frame/picture.glsl"
#include "camera/response.glsl"

uniform sampler2D photo;
uniform sampler2D layers;
uniform float cloud_softness;
uniform vec2 pass_size;

out vec4 result;

const float kReach = 0.055;  // about two deviations, in longer sides of the picture
const int kTaps = 6;         // on each side

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec2 pace = kReach / float(kTaps) * max(frame_size.x, frame_size.y) / frame_size;
  vec4 sum = vec4(vec3(1e-6), 1e-6);
  for (int i = -kTaps; i <= kTaps; ++i) {
    for (int j = -kTaps; j <= kTaps; ++j) {
      if (cloud_softness <= 0.0) break;
      vec2 tap = place + vec2(i, j) * pace;
      float matte = ReadPicture(layers, tap).r;
      float weight = matte * matte * exp(-2.4 * float(i * i + j * j) / float(kTaps * kTaps));
      sum += weight * vec4(GetSceneLight(ReadPicture(photo, tap).rgb), 1.0);
    }
  }
  result = vec4(sum.rgb / sum.a, 1.0);
}
