// The light on land that is the same everywhere, before and now, in the photo's
// scene-linear unit. Texels, for the photo's sun, and from 8 on for the moved one:
//   0 the sky's irradiance on a surface that faces up, 1 right, 2 left, 3 away, 4 the camera
//   5 light reflected by level land    6 the sun's irradiance at normal incidence, times sun_visibility
//   7 direction of the sun; alpha, of the moved one: share of any sun that the photo's sky lets through
//  16 mean share of the sun that reaches the land: r past land, g past clouds, before; b, a now

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "land/land_mean.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"

uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D shadow_source;
uniform sampler2D shadow_edit;
uniform sampler2D openness_source;
uniform sampler2D openness_edit;
uniform sampler2D veil_opacity;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_visibility;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform float source_sun_visibility;

out vec4 result;

const float kGroundAlbedo = 0.2;
const float kCloudLight = 0.5;  // light of clouds relative to a white cloud's sunlit side: most are seen from below
const float kSunny = 0.6;       // the sky counts as clear from this share of the sunlight expected from the relief
const vec2 kShineKnown = vec2(0.0, 0.05);  // sines of the photo's sun's height: land reveals the sky's clearness

// Mean share of the sun past land and past clouds over the dry land, because a landscape is not lit like one point. With
// hardly any land it is the share of the sun visible from the camera.
vec2 GetMeanSunShare(sampler2D shadow, float visible) {
  vec3 sum = 0.5 * vec3(visible, 1.0, 1.0);
  for (int i = 0; i < kTaps; ++i) {
    sum += GetDryLand(GetTap(i)) * vec3(ReadBilinear(shadow, GetTap(i)).rg, 1.0);
  }
  return sum.xy / sum.z;
}

// Means for the photo's sun: its share on the land as seen in the photo, its light there, and the light expected
// from the land's relief.
vec3 GetSunInPhoto(float visible) {
  vec4 sum = 0.5 * vec4(visible, visible, visible, 1.0);
  for (int i = 0; i < kTaps; ++i) {
    Relief land = ReadRelief(GetTap(i));
    float expected = ReadBilinear(shadow_source, GetTap(i)).b;
    sum += GetDryLand(GetTap(i)) * vec4(land.lit, land.lit * land.facing, expected, 1.0);
  }
  return sum.xyz / sum.w;
}

vec3 GetIrradiance(bool now, int index) {
  float moon = now ? GetMoon() : photo_light;
  vec3 light = now ? GetLightTexel(light_edit, index) : GetLightTexel(light_before, index);
  // Without a moon a surface receives only the night sky's light, from half the sphere.
  vec3 night = index == 1 ? vec3(0.0) : kPi * GetNightSky(moon);
  return sky_gain * (GetLightScale(moon) * light + night);
}

// Irradiance of the sky with its clouds: on surfaces that face up, or (`part` above 0) on upright ones.
vec3 GetSkyIrradiance(bool now, int part) {
  // light.glsl's order is up, sun, facing the camera, right, left, away.
  vec3 clear = GetIrradiance(now, part == 0 ? 0 : part == 4 ? 2 : part + 2);
  vec3 light = GetCloudRadiance(ReadDaylight(light_before), 0.0);
  if (now) light = GetCloudRadiance(ReadDaylight(light_edit), 0.0);
  vec3 white = sky_gain * GetLightScale(now ? GetMoon() : photo_light) * light;
  vec3 cloud = kCloudLight * (part == 0 ? kPi : 0.5 * kPi) * white;
  float veil = texelFetch(veil_opacity, ivec2(0), 0).r;
  float cover = now ? GetMeanCover(openness_edit, veil) : GetMeanCover(openness_source, veil);
  return clear + cover * max(cloud - clear, vec3(0.0));
}

void main() {
  int index = int(gl_FragCoord.x);
  vec3 sun_before = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  float visible = texelFetch(visibility_source, ivec2(0), 0).r;
  vec3 seen = GetSunInPhoto(visible);
  vec2 mean_before = vec2(seen.x, GetMeanSunShare(shadow_source, visible).y);
  vec2 mean_now = GetMeanSunShare(shadow_edit, texelFetch(visibility_edit, ivec2(0), 0).r);
  // A sky that blocks the photo's sun from the land also blocks any other sun.
  float known = smoothstep(kShineKnown.x, kShineKnown.y, sun_before.y);
  float sunny = min(seen.y / max(kSunny * seen.z, 1e-3), 1.0);
  float shine = 1.0 + known * (sunny - 1.0);
  mean_now.x = mean_before.x + GetShadowChange(sun_before, sun_now) * (shine * mean_now.x - mean_before.x);
  if (index == 16) {
    result = vec4(mean_before, mean_now);
    return;
  }
  bool now = index >= 8;
  int part = index - (now ? 8 : 0);
  vec3 sun = now ? sun_now : sun_before;
  float shown = now ? sun_visibility : source_sun_visibility;
  vec3 beam = shown * GetIrradiance(now, 1);
  if (part < 5) {
    result = vec4(GetSkyIrradiance(now, part), 1.0);
  } else if (part == 5) {
    vec2 mean = now ? mean_now : mean_before;
    vec3 direct = mean.x * mean.y * GetSoftCosine(sun.y, kRoughness) * beam;
    result = vec4(kGroundAlbedo * (GetSkyIrradiance(now, 0) + direct), 1.0);
  } else if (part == 6) {
    result = vec4(beam, 1.0);
  } else {
    result = vec4(sun, now ? shine : 1.0);
  }
}
