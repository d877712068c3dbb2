// What the gains of the channels hold beside the white balance. A camera that draws blue skies bluer than any
// air, or red ones redder, makes them carry it (lib/matched_sky.glsl): a sky that is not as blue any more
// loses so much of it, or it would turn teal.

#include "lib/matched_sky.glsl"

// Nearly the log of blue over red of the model's sky.
float GetBlueness(vec3 matched) {
  vec3 sky = matched / sky_gain;
  return 2.0 * (sky.b - sky.r) / (sky.b + sky.r);
}

// 0 where the sky is as it was.
float GetLostTint(vec3 sky_before, vec3 sky_now) {
  float side = sign(sky_gain.b - sky_gain.r);
  float before = side * GetBlueness(sky_before);
  float lost = before - side * GetBlueness(sky_now);
  return clamp(lost / max(before, 0.3), 0.0, 1.0) * smoothstep(0.0, 0.3, before);
}

vec3 WithoutLostTint(vec3 sky_before, vec3 sky_now) {
  vec3 tint = sky_gain / dot(sky_gain, vec3(0.2126, 0.7152, 0.0722));
  return sky_now * mix(vec3(1.0), 1.0 / tint, GetLostTint(sky_before, sky_now));
}
