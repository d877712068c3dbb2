// The colors of skies by day, as photos show them. Learned by training/skies/high_sun.py and dusk.py.

uniform vec3 photo_sky_linear_mean;

// Around a sun by day, whatever its height, blue skies turn white: red over green within 9 degrees (as 1 - cosine), blue
// over green within 7. Farther away they are hardly darker than skies without a sun, while the model's air is beige, and
// dark. Fits the medians of 76 photos. Pale skies and clouds keep their color as well: such photos are blue, gray or
// golden, but rarely tan.
const vec2 kWhitens = vec2(0.0132, 0.0081);
const vec2 kWhitensPower = vec2(0.95, 0.75);
const vec2 kBlueLight = vec2(-0.35, 2.4);  // log2 of light over the photo's: far away, and how much more beside the sun
const float kBlueLightFall = 4.1;  // per radian, of its square root
const float kOwnShare = 0.7;  // of the way to them, in color and in light
const float kBlueLightShare = 0.6;
const vec2 kBlue = vec2(0.2, 1.0);  // log2 of blue over red: a gray pixel's and a blue one's
const vec2 kBlueSky = vec2(0.6, 1.4);  // the same of the sky's mean
const vec2 kEveningSky = vec2(0.0, 0.3);  // log2 of red over green of the sky's mean
const vec2 kDay = vec2(0.1, 0.19);  // sine of the sun's height: lower suns keep their warmth

// Log2 of red over `channel` in the photo's mean sky.
float GetMeanRed(float channel) {
  return log2(max(photo_sky_linear_mean.r, 1e-4) / max(channel, 1e-4));
}

// How far the photo's sky is blue.
float GetBlueSky() {
  return smoothstep(kBlueSky.x, kBlueSky.y, -GetMeanRed(photo_sky_linear_mean.b));
}

// How far the photo's sky is an evening's.
float GetEveningSky() {
  return smoothstep(kEveningSky.x, kEveningSky.y, GetMeanRed(photo_sky_linear_mean.g));
}

// How far the photo's evening, if it is one, ends as its low sun has `risen`.
float GetEveningsEnd(float risen) {
  return min(2.0 * risen, 1.0) * GetEveningSky();
}

// The turn, as of TurnColor, of light of this `color` towards the photo's `own` as the sun, `cosine` away from it,
// stands by day; `fall` is the log2 of its light over the photo's. As a low sun has `risen`, its evening's colors leave.
vec3 GetOwnColorTurn(vec2 color, vec2 own, float fall, float cosine, float sun_y, float risen) {
  float day = smoothstep(kDay.x, kDay.y, sun_y);
  float blue_day = day * GetBlueSky();
  float evening = GetEveningsEnd(risen);
  vec2 kept = 1.0 - exp(-pow(max(1.0 - cosine, 0.0) / kWhitens, kWhitensPower));
  // What is not blue stays warm around the sun.
  float gray_share = day * (1.0 - evening) * kept.x;
  float share = mix(gray_share, mix(day, blue_day, evening), smoothstep(kBlue.x, kBlue.y, own.y - own.x));
  vec2 turn = share * (own * kept - color);
  // A brighter sky far away need not be near this sun.
  float near = exp(-kBlueLightFall * sqrt(max(2.0 - 2.0 * cosine, 0.0)));
  float light = kBlueLight.x + kBlueLight.y * near * near - fall;
  return vec3(kOwnShare * vec2(min(turn.x, 0.0), max(turn.y, 0.0)), kBlueLightShare * blue_day * max(light, near * light));
}

// By day skies are at least this blue, near the horizon and high above it: 1.7 times the medians of 1070 photos whose
// sun is assumed above 15 degrees, in stops; of several multiples readers preferred this one (docs/methods/effects.md).
const vec2 kDayBelow = vec2(-0.62, 0.54);
const vec2 kDayAbove = vec2(-1.2, 1.2);
const vec2 kDayBegins = vec2(0.2, 0.4);  // sine of the sun's height
// Clouds are gray by day: the share of that blue which they hide.
const float kGrayClouds = 0.8;
const float kWhiteClouds = 0.4;  // stops by which the sun lights them

// How far day begins as a low sun has `risen` to this height.
float GetDayBegun(float sun_y, float risen) {
  return risen * smoothstep(kDayBegins.x, kDayBegins.y, sun_y);
}

// The turn of a sky's `color` in the height `view_y`, behind a `cloud` of this opacity, towards that of such photos as
// day begins.
vec3 GetBlueDayTurn(vec2 color, float cloud, float view_y, float sun_y, float risen) {
  float blue = 1.0 - kGrayClouds * cloud;
  vec2 wanted = blue * mix(kDayBelow, kDayAbove, smoothstep(0.0, 0.6, view_y));
  wanted = vec2(min(wanted.x, color.x), max(wanted.y, color.y));
  // What would be violet becomes blue, with as much blue over red.
  wanted -= 0.5 * max(wanted.x + wanted.y, 0.0);
  return GetDayBegun(sun_y, risen) * vec3(wanted - color, kWhiteClouds * cloud);
}
