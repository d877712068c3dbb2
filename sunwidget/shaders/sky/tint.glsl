// The tint that the channel gains contain besides the white balance. A camera that renders blue skies bluer than
// any air, or red ones redder, puts a tint into them (sky/matched_sky.glsl). As a sky loses its blue it loses
// that tint in proportion, or it would turn teal.

#include "sky/matched_sky.glsl"
#include "sky/bounded.glsl"
#include "frame/srgb.glsl"

// Sunsets are only partly red: some of the tint stays where they would turn gray.
const float kMostOfRed = 0.6;
// Turn of the model's color (length of the log of its channels at constant luminance) at which the photo's
// own color has faded.
const float kTurned = 1.2;
const float kFadedAhead = 0.5;
// A low sun's sky held haze and cloud, which are paler by day than clear air.
const float kPale = 0.5;
const vec2 kRises = vec2(0.08, 0.25);  // sine of the sun's height
// 95 % of daytime photos have balances within these; the balances of evening photos contain the evening's light,
// too. Log2 of red over blue, and of green over both.
const float kReddest = 0.4;
const vec2 kGreens = vec2(-0.25, 0.45);
const float kBluest = 0.5;  // log2 of blue over red, above their median

// Approximately the log of blue over red in the model's sky.
float GetBlueness(vec3 matched) {
  vec3 sky = matched / sky_gain;
  return 2.0 * (sky.b - sky.r) / (sky.b + sky.r);
}

// Blueness and redness of the old sky between which a tint starts to be removed. Blue is removed from white skies,
// too, since it would turn them teal at the horizon.
const vec2 kBlueBefore = vec2(-1.2, 0.0);
const vec2 kRedBefore = vec2(-0.4, 0.6);

// The share of the tint that is lost; 0 where the sky is unchanged.
float GetLostTint(vec3 sky_before, vec3 sky_now) {
  float side = sign(sky_gain.b - sky_gain.r);
  float before = side * GetBlueness(sky_before);
  float lost = before - side * GetBlueness(sky_now);
  float most = side > 0.0 ? 1.0 : kMostOfRed;
  vec2 from = side > 0.0 ? kBlueBefore : kRedBefore;
  return most * GetBounded(max(lost, 0.0) / max(before, 0.3), 1.0) * smoothstep(from.x, from.y, before);
}

// Removes a share of the photo's balance from a light, which also changes its brightness.
vec3 RemoveBalance(vec3 light, float share) {
  return share > 0.0 ? light * pow(GetLuminance(sky_gain) / sky_gain, vec3(share)) : light;
}

// Green over red and blue, relative to the most violet of daytime photos, at most 1. Violet beyond that is a filter's, or
// a balance's for other light: it colors the whole picture, and without it a new sun's surroundings would be green. But
// an evening's violet leaves with the evening.
float GetViolet() {
  return min(sky_gain.g * exp2(-kGreens.x) * inversesqrt(sky_gain.r * sky_gain.b), 1.0);
}

// Removes the share `lost` of the tint, but neither brightness nor violet.
vec3 RemoveLostTint(vec3 sky, float lost) {
  vec3 tint = vec3(sky_gain.r, sky_gain.g / GetViolet(), sky_gain.b);
  vec3 color = sky * pow(tint, vec3(-lost));
  return color * (GetLuminance(sky) / GetLuminance(color));
}

// Removes `evening` of the balance from light that has `lost` a share of its tint already.
vec3 RemoveEvening(vec3 light, float lost, float evening) {
  return RemoveBalance(light, (1.0 - lost) * evening) * vec3(1.0, pow(GetViolet(), -lost * evening), 1.0);
}

// How far a low sun, or one below the horizon, has risen; otherwise 0.
float GetRisen(vec3 sun_before, vec3 sun_now) {
  if (sun_now.y <= sun_before.y) return 0.0;
  return GetSunToSun()
      * max(smoothstep(kRises.x, kRises.y, sun_now.y) - smoothstep(kRises.x, kRises.y, sun_before.y), 0.0);
}

// The share of the photo's balance that was the evening's light.
float GetEveningBalance() {
  vec3 gain = log2(sky_gain);
  float green = gain.g - 0.5 * (gain.r + gain.b);
  float beyond = max(gain.r - gain.b - kReddest, max(green - kGreens.y, kGreens.x - green));
  return smoothstep(0.0, 0.8, beyond);
}

// The share of it that was a deeper blue than air's, which clouds do not have.
float GetVividness() {
  return smoothstep(kBluest, kBluest + 1.0, log2(sky_gain.b / sky_gain.r));
}

// How much warmer a light is than `model`, [0, 1], its violet included: colors bluer than that and no less green were not
// the evening's, violet was its shade.
float GetWarmth(vec3 light, vec3 model) {
  vec3 redder = log(max(light.r * model, vec3(1e-12)) / max(light * model.r, vec3(1e-12)));
  return smoothstep(0.0, 0.5, max(max(redder.g, redder.b), redder.g - 0.5 * redder.b));
}

// How a ratio turns a color at constant luminance: log of its channels.
vec3 GetTurn(vec3 ratio, vec3 color) {
  return log(ratio * (GetLuminance(color) / GetLuminance(color * ratio)));
}

float GetTurned(vec3 ratio, vec3 color) {
  return smoothstep(0.0, kTurned, length(GetTurn(ratio, color)));
}

// The photo's sky differs from the model, `sky` over `before`, in light, which stays, and in color, which
// fades as far as the model's own color moves away: deep blue times yellow would be green. `relit` is
// `sky` times `ratio`.
vec3 ShiftToModelColor(vec3 relit, vec3 sky, vec3 before, vec3 ratio, float opacity, float cloud, vec3 sky_before,
                       vec3 sky_now, float risen) {
  vec3 now = before * ratio;
  vec3 turn = GetTurn(ratio, before);
  vec3 own = log(max(sky, vec3(1e-6)) / max(before, vec3(1e-6)));
  // Color in the direction of the turn may stay: blue in the red sky of a sunset, when the sun sets.
  float along = dot(own - dot(own, vec3(1.0 / 3.0)), turn) / max(length(turn), 1e-3);
  float faded = GetTurned(ratio, before) * mix(1.0, kFadedAhead, smoothstep(0.0, 1.0, along));
  float clear_lost = GetLostTint(sky_before, sky_now);
  float lost = (1.0 - opacity) * clear_lost;
  float evening = risen * GetEveningBalance();
  faded = max(faded, lost);
  now += (1.0 - opacity) * (RemoveLostTint(sky_now, clear_lost) * (GetLuminance(now) / GetLuminance(sky_now)) - now);
  vec3 day = RemoveBalance(RemoveEvening(now, lost, evening), max(cloud * GetVividness() - (1.0 - lost) * evening, 0.0));
  day += kPale * risen * (GetLuminance(day) - day);
  vec3 model = day * (GetLuminance(now) / GetLuminance(day) * GetLuminance(sky) / GetLuminance(before));
  faded = max(faded, risen * GetWarmth(relit, model));
  vec3 turned = relit + faded * (model - relit);
  // A sky never turns greener than it was.
  float greenest = max(sky.g / max(max(sky.r, sky.b), 1e-6), 1.0);
  turned.g -= smoothstep(0.0, 0.1, faded) * max(turned.g - greenest * max(turned.r, turned.b), 0.0);
  return turned;
}
