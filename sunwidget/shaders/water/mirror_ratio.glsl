// Change of mirrored light from the photo's sun to the moved one: rgb the ratio, a the new sun's
// glints per unit of its light. Water mirrors the sky, less at steeper views, and the
// water's own light follows its irradiance; the frame adds the glints (water/water.glsl). Shiny
// land mirrors sky and sun together.

#include "frame/picture.glsl"
#include "frame/composite_texels.glsl"
#include "camera/response.glsl"
#include "water/glint.glsl"
#include "land/gloss.glsl"

uniform sampler2D mirror_source;
uniform sampler2D mirror_edit;
uniform sampler2D surface;
uniform sampler2D mirrored_clouds;
uniform sampler2D composite_constants;
uniform sampler2D land_terms;
uniform vec2 pass_size;
uniform float wind_speed;
uniform float source_wind_speed;
uniform float glitter;
uniform float water_strength;

out vec4 result;

// The true light of a clipped glint is unknown: it may fade freely, but hardly grow.
const float kLargestGrowth = 2.0;
// Asphalt, wet sand, roofs.
const float kRoadRoughness = 0.3;
// Irradiance reflectance of the sea just below its surface, between clear ocean and coast
// (Jerlov 1976): water absorbs red.
const vec3 kWaterReflectance = vec3(0.008, 0.025, 0.035);

// Light of the water itself under an irradiance, without the share that the surface reflects.
vec3 GetWaterLight(vec3 irradiance, vec3 view, float wind) {
  return (1.0 - GetFresnel(GetFacing(view, wind))) * kWaterReflectance / 3.14159265 * irradiance;
}

vec3 GetConstant(int index) {
  return texelFetch(composite_constants, ivec2(index, 0), 0).rgb;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 place = gl_FragCoord.xy / pass_size;
  vec4 marks = ReadBilinear(surface, place);
  vec4 before = texelFetch(mirror_source, texel, 0);
  vec4 now = texelFetch(mirror_edit, texel, 0);
  vec3 view = GetViewDirection(place);

  float cloud = texelFetch(mirrored_clouds, texel, 0).r;
  float share = GetFresnel(GetFacing(view, source_wind_speed));
  vec3 sky_before = before.rgb + cloud * (share * GetConstant(kCloudBefore) - before.rgb);
  vec3 sky_now = now.rgb + cloud * (share * GetConstant(kCloudNow) - now.rgb);
  vec3 water = GetRatio(sky_now + GetWaterLight(GetConstant(kLevelLandNow), view, wind_speed),
                        sky_before + GetWaterLight(GetConstant(kLevelLandBefore), view, source_wind_speed));
  // Land mirrors the sun with a rougher surface than water, in a wide lobe around its glints.
  float shine_before = GetGroundLobe(view, texelFetch(land_terms, ivec2(7, 0), 0).xyz, kRoadRoughness);
  float shine_now = GetGroundLobe(view, texelFetch(land_terms, ivec2(15, 0), 0).xyz, kRoadRoughness);
  vec3 gleam = before.rgb + shine_before * GetConstant(kWaterSunBefore);
  vec3 shine = min(GetRatio(now.rgb + shine_now * GetConstant(kWaterSunNow), gleam), vec3(kLargestGrowth));
  // Clipped glints are white in the photo, whatever their true color.
  vec3 bleached = gleam / GetLuminance(gleam);
  shine *= 1.0 + marks.b * GetConstant(kGains).y * (bleached - 1.0);
  float water_share = marks.g * water_strength;
  result = vec4(shine + water_share * (water - shine), glitter * now.a);
}
