// r: how much brighter the photo's sky without its sun is than the model with clouds, slowly varying (log of
// luminance). g: how far that exceeds the rest of the sky, away from the sun. b: luminance of the land nearby, almost 0
// where there is none. a: what r and g change by if the model's clouds show the peak around a sun that they hide.
// Drawn once per photo.

#define PHOTOS_OWN_LIGHT
#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"
#include "clouds/cloud_light.glsl"
#include "sky/nearness.glsl"
#include "camera/response.glsl"

uniform sampler2D photo;
uniform sampler2D layers;
uniform sampler2D backdrop;
uniform sampler2D sky_view;
uniform sampler2D light_before;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform vec2 pass_size;

out vec4 result;

const float kReach = 0.1;  // two deviations, in longer sides of the picture
const int kTaps = 6;       // on each side
const int kElsewhere = 12;  // columns and rows of taps over the whole picture
const float kFewest = 1.0;  // total weight of taps elsewhere at which g has half its size

float GetInside(vec2 tap) {
  return step(0.0, tap.x) * step(tap.x, 1.0) * step(0.0, tap.y) * step(tap.y, 1.0);
}

float GetWeight(vec2 tap) {
  float matte = ReadPicture(layers, tap).r;
  return GetInside(tap) * matte * matte;
}

// Log of the photo's luminance over the model's: of x the clouds hide the sun, unless the photo shows it; of y they do not.
vec2 GetLogExcess(vec2 tap, vec3 ambient, vec3 direct) {
  vec4 layer = ReadPicture(layers, tap);
  vec3 light = GetBackdropLight(ReadBilinear(backdrop, tap).rgb);
  vec3 view = GetViewDirection(tap);
  vec3 sun = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  float opacity = GetKnownOpacity(min(layer.g / layer.r, 1.0), sun);
  vec3 clear = GetMatchedSky(sky_view, view);
  vec2 model;
  for (int i = 0; i < 2; ++i) {
    vec3 sky = i == 0 ? GetSkyBehindClouds(clear, ambient, opacity * (1.0 - sun_visible)) : clear;
    float share = GetSunlitShare(light, sky, ambient, direct, opacity);
    model[i] = GetLuminance(mix(sky, GetCloud(ambient, direct, share, sky, sun, view, opacity), opacity));
  }
  return log(max(GetLuminance(light), 1e-6) / max(model, vec2(1e-6)));
}

void main() {
  vec3 sun = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 scale = sky_gain * GetLightScale(photo_light);
  Daylight light = ReadDaylight(light_before);
  vec3 white = scale * GetCloudRadiance(light, 0.0);
  vec3 direct = scale * GetCloudRadiance(light, 1.0) - white;
  vec3 ambient = white - direct;
  vec2 place = gl_FragCoord.xy / pass_size;
  vec2 pace = kReach / float(kTaps) * max(frame_size.x, frame_size.y) / frame_size;
  vec2 sum = vec2(0.0);
  float total = 1e-6;
  // Of the land nearby a geometric mean: dark twigs count as much as what lies behind them.
  vec2 land = vec2(-0.01, 1e-3);
  for (int i = -kTaps; i <= kTaps; ++i) {
    for (int j = -kTaps; j <= kTaps; ++j) {
      vec2 tap = place + vec2(i, j) * pace;
      float near = GetInside(tap) * step(ReadPicture(layers, tap).r, 0.02) * exp(-float(i * i + j * j));
      land += near * vec2(log(max(GetLuminance(GetSceneLight(ReadPicture(photo, tap).rgb)), 1e-4)), 1.0);
      float weight = GetWeight(tap) * exp(-2.0 * float(i * i + j * j) / float(kTaps * kTaps));
      if (weight < 1e-4) continue;
      sum += weight * GetLogExcess(tap, ambient, direct);
      total += weight;
    }
  }
  vec2 own = sum / total;

  float elsewhere = 0.0;
  float known = 0.0;
  for (int i = 0; i < kElsewhere; ++i) {
    for (int j = 0; j < kElsewhere; ++j) {
      vec2 tap = (vec2(i, j) + 0.5) / float(kElsewhere);
      float far = 1.0 - GetNearness(dot(GetViewDirection(tap), sun));
      float weight = GetWeight(tap) * far * far;
      if (weight < 1e-4) continue;
      elsewhere += weight * GetLogExcess(tap, ambient, direct).x;
      known += weight;
    }
  }
  elsewhere /= max(known, 1e-4);
  float more = known / (known + kFewest) * (own.x - elsewhere);
  result = vec4(own.x, more, exp(land.x / land.y), own.y - own.x);
}
