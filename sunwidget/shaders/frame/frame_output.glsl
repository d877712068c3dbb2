// Adds a change of scene-linear light to the photo.

#include "camera/response.glsl"
#include "frame/output.glsl"
#include "camera/grain.glsl"

uniform float output_white;  // limit of the highlights: 1 the display's white, more if the target holds light above it

// Highlights roll off from here on; display-linear.
const float kKnee = 0.5;
const float kToe = 0.0035;
const float kOvershoot = 1.06;  // asymptote, in units of the distance from knee to white: the sun itself clips

// Display-linear light with the highlights of a good camera. Pixels that became `brighter`, 0 to 1, leave the
// response at the knee and approach white slowly, without a flat plate. Warm and blue colors do so channel by channel,
// which turns a sunset's orange yellow, as film does, and keeps a sky azure, which mixed with white would be lilac;
// others keep their hue. The core is white. The effect scales with how far the pixel has `changed`, 0 to 1. With a
// higher `output_white` highlights rise further, by the same curve from the same knee.
vec3 GetRolledOff(vec3 scene, float brighter, float changed) {
  float w = max(response_shoulder, 1e-4);
  float luminance = max(GetLuminance(scene), 1e-9);
  vec4 r = pow(max(vec4(scene, luminance), vec4(1e-9)), vec4(response_contrast));
  vec4 plain = (1.0 - exp(-w * r)) / w;
  float knee = -log(1.0 - w * kKnee) / w;
  vec4 over = (1.0 - w * kKnee) / (output_white - kKnee) * max(r - knee, vec4(0.0));
  vec4 slow = kKnee + (output_white - kKnee) * kOvershoot * over / (1.0 + over);
  vec4 level = min(plain + brighter * step(knee, r) * (slow - plain), vec4(0.9999 * output_white));
  vec3 color = scene / luminance - 1.0;
  color.g -= smoothstep(0.5, 0.8, level.a) * max(color.g - max(color.r, color.b), 0.0);  // no light is green
  float x = max(color.r, max(color.g, color.b)) * level.a / (output_white - level.a);
  vec3 same_hue = level.a + level.a * inversesqrt(1.0 + x * x) * color;
  float vivid = smoothstep(0.0, 0.8, abs(color.r - color.b)) * (1.0 - smoothstep(0.75, 1.0, level.a / output_white));
  float bright = smoothstep(0.4, 0.8, max(plain.r, max(plain.g, plain.b)));
  return plain.rgb + changed * bright * (mix(same_hue, level.rgb, vivid) - plain.rgb);
}

// Keeps darkened pixels from black, as a good print does: display-linear light to add, more for darker pixels, up to
// kToe, and never so much that a pixel that lost light gains.
float GetToe(vec3 light, vec3 before) {
  float level = max(GetLuminance(before), 1e-9);
  return kToe * level / (level + kToe) * max(1.0 - max(GetLuminance(light), 0.0) / level, 0.0);
}

// Written as a difference, so that unchanged light adds exactly zero. `filled` pixels get the photo's
// noise (camera/grain.glsl).
void WriteChange(vec3 display, vec3 scene, vec3 change, float filled, vec2 pixel) {
  float touched = step(1e-30, dot(abs(change), vec3(1.0)));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  vec3 now = scene + change;
  float old = GetLuminance(scene) / max(GetLuminance(now), 1e-9);
  vec3 share = abs(change) / max(max(now, scene), vec3(1e-9));
  float most = max(share.r, max(share.g, share.b));
  vec3 light = GetRolledOff(now, max(1.0 - old * old, 0.0), most * most / (most * most + 0.01));
  light += GetToe(light, representable) + GetGrain(light, representable, filled, pixel);
  WriteFrame(display, touched * (light - representable), pixel);
}
