// What the gains of the channels hold beside the white balance. A camera that draws blue skies bluer than any
// air, or red ones redder, makes them carry it (sky/matched_sky.glsl): a sky that is not as blue any more
// loses so much of it, or it would turn teal.

#include "sky/matched_sky.glsl"
#include "frame/srgb.glsl"

// Sunsets are red in parts: where they would end in gray some of it stays.
const float kMostOfRed = 0.6;
// How far the model's color has turned (length of the log of its channels, as bright) when the photo's
// own has faded.
const float kTurned = 1.2;
const float kFadedAhead = 0.5;
// What stood in the sky of a low sun was haze and cloud, and is paler by day than clear air.
const float kPale = 0.5;
const vec2 kRises = vec2(0.08, 0.25);  // sine of the sun's height
// The balances of 95 in 100 photos of a day lie within these, those of an evening hold its light, too. Log2 of red over
// blue, and of green over both.
const float kReddest = 0.4;
const vec2 kGreens = vec2(-0.25, 0.45);
const float kBluest = 0.5;  // log2 of blue over red: more than that of half of them

// Nearly the log of blue over red of the model's sky.
float GetBlueness(vec3 matched) {
  vec3 sky = matched / sky_gain;
  return 2.0 * (sky.b - sky.r) / (sky.b + sky.r);
}

// From which blueness, or redness, of the sky before on a tint may be lost. Blue goes from white skies, too: at the
// horizon it would turn them teal.
const vec2 kBlueBefore = vec2(-1.2, 0.0);
const vec2 kRedBefore = vec2(-0.4, 0.6);

// 0 where the sky is as it was.
float GetLostTint(vec3 sky_before, vec3 sky_now) {
  float side = sign(sky_gain.b - sky_gain.r);
  float before = side * GetBlueness(sky_before);
  float lost = before - side * GetBlueness(sky_now);
  float most = side > 0.0 ? 1.0 : kMostOfRed;
  vec2 from = side > 0.0 ? kBlueBefore : kRedBefore;
  return most * clamp(lost / max(before, 0.3), 0.0, 1.0) * smoothstep(from.x, from.y, before);
}

// Takes a share of the photo's balance out of a light, which then differs in brightness.
vec3 WithoutBalance(vec3 light, float share) {
  return share > 0.0 ? light * pow(GetLuminance(sky_gain) / sky_gain, vec3(share)) : light;
}

// The sky as bright as it is now.
vec3 WithoutLostTint(vec3 sky_before, vec3 sky_now) {
  vec3 color = WithoutBalance(sky_now, GetLostTint(sky_before, sky_now));
  return color * (GetLuminance(sky_now) / GetLuminance(color));
}

// 0 unless a sun that was low or below the horizon has risen.
float GetRisen(vec3 sun_before, vec3 sun_now) {
  if (sun_now.y <= sun_before.y) return 0.0;
  return (1.0 - photo_light) * (1.0 - GetMoon())
      * max(smoothstep(kRises.x, kRises.y, sun_now.y) - smoothstep(kRises.x, kRises.y, sun_before.y), 0.0);
}

// What of the photo's balance was the evening's light.
float GetEveningsBalance() {
  vec3 gain = log2(sky_gain);
  float green = gain.g - 0.5 * (gain.r + gain.b);
  float beyond = max(gain.r - gain.b - kReddest, max(green - kGreens.y, kGreens.x - green));
  return smoothstep(0.0, 0.8, beyond);
}

// What of it was a deeper blue than air's: none of it is a cloud's.
float GetVividness() {
  return smoothstep(kBluest, kBluest + 1.0, log2(sky_gain.b / sky_gain.r));
}

// How a ratio turns a color, as bright: log of its channels.
vec3 GetTurn(vec3 ratio, vec3 color) {
  return log(ratio * (GetLuminance(color) / GetLuminance(color * ratio)));
}

float GetTurned(vec3 ratio, vec3 color) {
  return smoothstep(0.0, kTurned, length(GetTurn(ratio, color)));
}

// What the photo's sky has beyond the model, `sky` over `before`, is light, which stays, and color, which
// fades as far as the model's own color moves away: deep blue times yellow would be green. `relit` is
// `sky` times `ratio`.
vec3 WithModelsColor(vec3 relit, vec3 sky, vec3 before, vec3 ratio, float opacity, float cloud, vec3 sky_before,
                     vec3 sky_now, float risen) {
  vec3 now = before * ratio;
  vec3 turn = GetTurn(ratio, before);
  vec3 own = log(max(sky, vec3(1e-6)) / max(before, vec3(1e-6)));
  // What lies on the way may stay: blue in the red sky of a sunset, when the sun goes.
  float along = dot(own - dot(own, vec3(1.0 / 3.0)), turn) / max(length(turn), 1e-3);
  float faded = GetTurned(ratio, before) * mix(1.0, kFadedAhead, smoothstep(0.0, 1.0, along));
  float lost = (1.0 - opacity) * GetLostTint(sky_before, sky_now);
  faded = max(faded, lost);
  now += (1.0 - opacity) * (WithoutLostTint(sky_before, sky_now) * (GetLuminance(now) / GetLuminance(sky_now)) - now);
  // Some of the balance has gone with the lost tint.
  vec3 day = WithoutBalance(now, max((1.0 - lost) * risen * GetEveningsBalance(), cloud * GetVividness()));
  day += kPale * risen * (GetLuminance(day) - day);
  vec3 model = day * (GetLuminance(now) / GetLuminance(day) * GetLuminance(sky) / GetLuminance(before));
  // What is bluer than that, and no less green, was no evening's color; violet was one's shade.
  vec3 redder = log(max(relit.r * model, vec3(1e-12)) / max(relit * model.r, vec3(1e-12)));
  float warmer = smoothstep(0.0, 0.5, max(max(redder.g, redder.b), redder.g - 0.5 * redder.b));
  faded = max(faded, risen * warmer);
  vec3 turned = relit + faded * (model - relit);
  // No sky turns greener than it was.
  float greenest = max(sky.g / max(max(sky.r, sky.b), 1e-6), 1.0);
  turned.g -= smoothstep(0.0, 0.1, faded) * max(turned.g - greenest * max(turned.r, turned.b), 0.0);
  return turned;
}
