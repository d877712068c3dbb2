// What the gains of the channels hold beside the white balance. A camera that draws blue skies bluer than any
// air, or red ones redder, makes them carry it (lib/matched_sky.glsl): a sky that is not as blue any more
// loses so much of it, or it would turn teal.

#include "lib/matched_sky.glsl"

// log of blue over red of the model's sky, bent to -1 .. 1.
float GetBlueness(vec3 matched) {
  vec3 sky = matched / sky_gain;
  float x = log(max(sky.b, 1e-9) / max(sky.r, 1e-9));
  return x / (abs(x) + 0.4);
}

// 0 where the sky is as it was.
float GetLostTint(vec3 sky_before, vec3 sky_now) {
  float side = sign(sky_gain.b - sky_gain.r);
  float before = GetBlueness(sky_before);
  float lost = side * (before - GetBlueness(sky_now));
  return clamp(lost * smoothstep(0.0, 0.5, side * before), 0.0, 1.0);
}

vec3 WithoutLostTint(vec3 sky_before, vec3 sky_now) {
  vec3 tint = sky_gain / dot(sky_gain, vec3(0.2126, 0.7152, 0.0722));
  return sky_now * pow(tint, vec3(-GetLostTint(sky_before, sky_now)));
}
