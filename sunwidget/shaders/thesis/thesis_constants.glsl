// Values shared by all pixels of the thesis' picture: its statistics, the land's change (eq. 3.7), the new sun's disc.

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/daylight.glsl"
#include "frame/srgb.glsl"

uniform sampler2D columns;
uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform sampler2D thesis_statistics;
uniform sampler2D thesis_mean_source;
uniform sampler2D thesis_mean_edit;

uniform int method;
uniform float sun_sky_ratio;
uniform float thesis_saturation;
uniform vec3 photo_sky_linear_mean;   // S̄ of the photo
uniform vec3 photo_land_linear_mean;  // F̄ of the photo
uniform float sun_mask_share;         // sun mask pixels over sky pixels, in the photo
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_size;
uniform float altitude;

flat out vec4 model_mean;       // lαβ of the model at the photo's sun
flat out vec4 model_deviation;
flat out vec4 land_change;      // rgb the factor of eq. 3.7; a the power of eq. 3.8
flat out vec4 disc_extent;      // xyz the disc's direction; a its radius, as a chord
flat out vec4 disc_height;      // sine of the elevation of its visible part's middle, inverse of half its height
flat out vec4 disc_path[3];     // log2 of the transmittance to that part: value in the middle, slope and bend

// The color of the sun's light: white, filtered by its path through the air.
vec3 GetSunColor(sampler2D light) {
  vec3 sun = GetLightTexel(light, 7);
  return sun / max(GetLuminance(sun), 1e-9);
}

// S̄ with the sun's pixels amplified by F^s. Corrected: the disc adds a fixed share of the sky's
// mean (the true disc at F^s = 1000 adds a quarter), dimmed by the air; as printed: the weight
// applies to the mask's pixels, whatever their number.
vec3 GetSkyMean(vec3 mean, sampler2D light, float visible) {
  if (method == 2) {
    float share = sun_sky_ratio * sun_mask_share * visible;
    return (mean + share * vec3(1.0)) / (1.0 + share);
  }
  float beam = GetLuminance(GetLightTexel(light, 1)) / max(GetLuminance(GetLightTexel(light_before, 7)), 1e-9);
  return mean + 0.25 * sun_sky_ratio / 1000.0 * visible * beam
      * GetLuminance(texelFetch(thesis_mean_source, ivec2(0), 0).rgb) * GetSunColor(light);
}

vec3 GetLandFactor(float visible_before, float visible_now) {
  vec3 mean_now = GetSkyMean(texelFetch(thesis_mean_edit, ivec2(0), 0).rgb, light_edit, visible_now);
  if (method == 2) {
    vec3 mean_photo = GetSkyMean(photo_sky_linear_mean, light_before, 1.0);
    vec3 land_mean = max(photo_land_linear_mean, vec3(1e-3));
    return mean_photo / land_mean * mean_now / land_mean;                      // 3.7 as printed
  }
  vec3 mean_first = GetSkyMean(texelFetch(thesis_mean_source, ivec2(0), 0).rgb, light_before, visible_before);
  return mean_now / max(mean_first, vec3(1e-4));                               // 3.7
}

// Log2 of the transmittance to the top of the atmosphere.
vec4 GetPath(float sine_of_elevation) {
  return log2(max(GetTransmittanceToTop(columns, altitude, sine_of_elevation), vec4(1e-30)));
}

void SetDisc() {
  disc_extent = vec4(GetSunDirection(sun_azimuth, sun_elevation), kSunAngularRadius * sun_size);
  // From the horizon, or the lower edge if above it, to the upper edge; pixels on an edge extend past it.
  float reach = disc_extent.a + 0.5 / (camera_focal * frame_size.y);
  float low = max(disc_extent.y - reach, GetCosineOfHorizon(altitude));
  float high = max(disc_extent.y + reach, low + 1e-4);
  disc_height = vec4(0.5 * (low + high), 2.0 / (high - low), 0.0, 0.0);
  vec4 upper = GetPath(high);
  vec4 lower = GetPath(low);
  disc_path[0] = GetPath(disc_height.x);
  disc_path[1] = 0.5 * (upper - lower);
  disc_path[2] = 0.5 * (upper + lower) - disc_path[0];
}

void SetConstants() {
  SetDisc();
  float visible_before = texelFetch(visibility_source, ivec2(0), 0).r;
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;
  model_mean = texelFetch(thesis_statistics, ivec2(0, 0), 0);
  model_deviation = texelFetch(thesis_statistics, ivec2(1, 0), 0);
  float power = 1.0 - (1.0 - thesis_saturation) * clamp(visible_before - visible_now, 0.0, 1.0);
  land_change = vec4(GetLandFactor(visible_before, visible_now), power);
}
