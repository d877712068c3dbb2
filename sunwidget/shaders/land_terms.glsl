// The light on the land that is the same for all its places, before and now, in the photo's
// scene-linear unit. Texels, for the photo's sun, and from 8 on for the moved one:
//   0 the sky's irradiance on a surface that faces up, 1 right, 2 left, 3 away, 4 the camera
//   5 what lying land throws up    6 the sun's irradiance at normal incidence; alpha: sun_visibility
//   7 direction of the sun
//  16 what of the sun reaches the land on average: r past land, g past clouds, before; b, a now

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/land_depth.glsl"
#include "lib/matched_sky.glsl"
#include "lib/daylight.glsl"

uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D shadow_source;
uniform sampler2D shadow_edit;
uniform sampler2D land_depth;
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
const int kColumns = 24;
const int kRows = 16;

// A landscape is not lit as one point: the mean over its places. With hardly any land it is what
// the camera itself sees of the sun.
vec2 GetMean(sampler2D shadow, float visible) {
  vec3 sum = 0.5 * vec3(visible, 1.0, 1.0);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      vec2 place = (vec2(column, row) + 0.5) / vec2(kColumns, kRows);
      sum += ReadLandDepth(land_depth, place).g * vec3(ReadBilinear(shadow, place).rg, 1.0);
    }
  }
  return sum.xy / sum.z;
}

vec3 GetIrradiance(bool now, int index) {
  float moon = now ? GetMoon() : photo_light;
  vec3 light = now ? GetLightTexel(light_edit, index) : GetLightTexel(light_before, index);
  // Without a moon no light reaches a surface but the night sky's, from half the sphere.
  vec3 night = index == 1 ? vec3(0.0) : PI * GetNightSky(moon);
  return sky_gain * (GetLightScale(moon) * light + night);
}

void main() {
  int index = int(gl_FragCoord.x);
  vec2 mean_before = GetMean(shadow_source, texelFetch(visibility_source, ivec2(0), 0).r);
  vec2 mean_now = GetMean(shadow_edit, texelFetch(visibility_edit, ivec2(0), 0).r);
  if (index == 16) {
    result = vec4(mean_before, mean_now);
    return;
  }
  bool now = index >= 8;
  int part = index - (now ? 8 : 0);
  vec3 sun = now ? GetSunDirection(sun_azimuth, sun_elevation)
      : GetSunDirection(source_sun_azimuth, source_sun_elevation);
  float shown = now ? sun_visibility : source_sun_visibility;
  vec3 beam = shown * GetIrradiance(now, 1);
  // light.glsl's order is up, sun, facing the camera, right, left, away.
  int texel = part == 0 ? 0 : part == 4 ? 2 : part + 2;
  if (part < 5) {
    result = vec4(GetIrradiance(now, texel), 1.0);
  } else if (part == 5) {
    vec2 mean = now ? mean_now : mean_before;
    result = vec4(kGroundAlbedo * (GetIrradiance(now, 0) + mean.x * mean.y * GetSoftCosine(sun.y, kRoughness) * beam), 1.0);
  } else if (part == 6) {
    result = vec4(beam, 1.0);
  } else {
    result = vec4(sun, 1.0);
  }
}
