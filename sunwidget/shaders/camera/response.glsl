// The camera's response: display-linear x in [0, 1] against scene-linear light.
// x = (1 - exp(-w r)) / w with r = light^contrast: a straight line for small r and a shoulder
// above. w = 0 is a straight line throughout, w = 1 the middle of film and of most tone mappers.
// Both are fitted to the photo's sky (analysis/fit/fit.py).

uniform float response_shoulder;  // w in [0, 0.995]
uniform float response_contrast;  // 0.7 .. 1.15

#include "frame/srgb.glsl"

// Distance from its asymptote up to which the response is inverted; brighter values are clamped.
const float kDeepestShoulder = 0.003;

float GetWhiteLevel() {
  return (1.0 - kDeepestShoulder) / max(response_shoulder, 1e-4);
}

vec3 GetSceneLight(vec3 display) {
  float w = max(response_shoulder, 1e-4);
  vec3 r = -log(max(1.0 - w * max(display, vec3(0.0)), vec3(kDeepestShoulder))) / w;
  return pow(max(r, vec3(1e-6)), vec3(1.0 / response_contrast));
}

// Decodes the backdrop of analysis/backdrop/backdrop.py: scene-linear light up to 16.
vec3 GetBackdropLight(vec3 code) {
  return (exp2(10.0 * code) - 1.0) / 64.0;
}

vec3 GetDisplayLight(vec3 scene) {
  float w = max(response_shoulder, 1e-4);
  return (1.0 - exp(-w * pow(max(scene, vec3(1e-9)), vec3(response_contrast)))) / w;
}

// new / old, exactly one on every driver if the two agree to the bit, and precise in deep
// twilight, where it is a millionth.
vec3 GetRatio(vec3 now, vec3 before) {
  return mix(now / before, vec3(1.0), equal(now, before));
}
