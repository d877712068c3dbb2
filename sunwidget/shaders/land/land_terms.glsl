// The light on the land that is the same for all its places, before and now, in the photo's
// scene-linear unit. Texels, for the photo's sun, and from 8 on for the moved one:
//   0 the sky's irradiance on a surface that faces up, 1 right, 2 left, 3 away, 4 the camera
//   5 what lying land throws up    6 the sun's irradiance at normal incidence; alpha: sun_visibility
//   7 direction of the sun; alpha, of the moved one: what the photo's sky lets through of any sun
//  16 what of the sun reaches the land on average: r past land, g past clouds, before; b, a now

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
const float kCloudLight = 0.5;  // of that of a white cloud's sunlit side: most are seen from below
const float kSunny = 0.6;       // of the sunlight that a land's relief lets expect: by so much its sky lets it through
const vec2 kTellsShine = vec2(0.0, 0.05);  // sine of the photo's sun's height from which its land tells that

// A landscape is not lit as one point: the mean over its dry places. With hardly any land it is what the camera
// itself sees of the sun.
vec2 GetMean(sampler2D shadow, float visible) {
  vec3 sum = 0.5 * vec3(visible, 1.0, 1.0);
  for (int i = 0; i < kTaps; ++i) {
    sum += GetDryLand(GetTap(i)) * vec3(ReadBilinear(shadow, GetTap(i)).rg, 1.0);
  }
  return sum.xy / sum.z;
}

// Of the photo's sun: what reaches the land by what the photo shows, how much light it throws there, and how much
// the land's relief lets expect.
vec3 GetSeen(float visible) {
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
  // Without a moon no light reaches a surface but the night sky's, from half the sphere.
  vec3 night = index == 1 ? vec3(0.0) : kPi * GetNightSky(moon);
  return sky_gain * (GetLightScale(moon) * light + night);
}

// The sky's irradiance with the clouds that it has: up, or (`part` above 0) on upright surfaces.
vec3 GetSkyIrradiance(bool now, int part) {
  // light.glsl's order is up, sun, facing the camera, right, left, away.
  vec3 clear = GetIrradiance(now, part == 0 ? 0 : part == 4 ? 2 : part + 2);
  vec3 light = now ? GetCloudRadiance(light_edit, 0.0) : GetCloudRadiance(light_before, 0.0);
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
  vec3 seen = GetSeen(visible);
  vec2 mean_before = vec2(seen.x, GetMean(shadow_source, visible).y);
  vec2 mean_now = GetMean(shadow_edit, texelFetch(visibility_edit, ivec2(0), 0).r);
  // A sky that keeps the sun from the land in the photo keeps any sun from it.
  float tells = smoothstep(kTellsShine.x, kTellsShine.y, sun_before.y);
  float sunny = min(seen.y / max(kSunny * seen.z, 1e-3), 1.0);
  float shine = 1.0 + tells * (sunny - 1.0);
  mean_now.x = mean_before.x + GetOtherShadows(sun_before, sun_now) * (shine * mean_now.x - mean_before.x);
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
