// The picture, method "ratio": every term is a ratio new/old of one model at two suns, so an
// unmoved sun multiplies by exactly one. Where a ratio means nothing (clipped pixels, the old
// disc and its halo, extreme ratios) the frame cross-fades to the matched model itself.

#include "lib/picture.glsl"
#include "lib/response.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/daylight.glsl"
#include "lib/output.glsl"

uniform sampler2D photo;
uniform sampler2D columns;
uniform sampler2D layers;
uniform sampler2D surface;
uniform sampler2D backdrop;
uniform sampler2D sky_source;
uniform sampler2D sky_edit;
uniform sampler2D sky_view_source;
uniform sampler2D sky_view_edit;
uniform sampler2D light_source;
uniform sampler2D light_edit;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform sampler2D meter_source;
uniform sampler2D meter_edit;

uniform float sun_azimuth;
uniform float sun_elevation;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform float source_land_facing;
uniform float altitude;
uniform float sun_size;
uniform float sky_strength;
uniform float cloud_strength;
uniform float silver_lining;
uniform float land_strength;
uniform float land_facing;
uniform float colourfulness;
uniform float exposure;
uniform float auto_exposure;

// Over this many degrees of movement the old sun's glare gives way to the sky behind it: long
// enough that a pixel's drag shows no step, short enough that a moved sun leaves no ghost.
const float kGlareFade = 4.0;

// Henyey–Greenstein lobe over its isotropic value, g = 0.8.
float GetForwardLobe(float cosine) {
  const float g = 0.8;
  return (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
}

// Light of a cloud of this opacity: what falls on it, and what comes through it from the sky
// behind and around, the more the thinner it is.
vec3 GetCloud(sampler2D light, vec3 sky_behind, vec3 sun, vec3 view, float opacity) {
  float forward = silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  vec3 lit = sky_gain * GetCloudRadiance(light, 0.25 * forward);
  return mix(lit, sky_behind, 0.7 * (1.0 - opacity) + 0.15);
}

void main() {
  vec2 pixel = GetPixel();
  vec2 place = pixel / frame_size;
  ivec2 texel = ivec2(pixel - tile_origin);
  vec3 view = GetViewDirection(place);
  vec3 display = ReadPicture(photo, place).rgb;
  vec3 scene = GetSceneLight(display);
  vec4 layer = ReadPicture(layers, place);
  float glare = ReadPicture(surface, place).r;
  vec3 sky_before = texelFetch(sky_source, ivec2(texel), 0).rgb;
  vec3 sky_now = texelFetch(sky_edit, ivec2(texel), 0).rgb;

  vec3 sun_before = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  float turn = degrees(2.0 * asin(min(0.5 * length(sun_now - sun_before), 1.0)));
  float moved = smoothstep(0.0, kGlareFade, turn);

  float stops = exposure + auto_exposure * (texelFetch(meter_source, ivec2(0), 0).r - texelFetch(meter_edit, ivec2(0), 0).r);
  float gain = exp2(stops);

  // Sky and clouds.
  vec3 clean = sky_before * exp(4.0 * ReadBilinear(backdrop, place).rgb - 2.0);
  vec3 sky = scene + glare * moved * (clean - scene);
  float opacity = layer.g;
  vec3 veil_before = (1.0 - opacity) * sky_before + opacity * GetCloud(light_source, sky_before, sun_before, view, opacity);
  vec3 veil_now = (1.0 - opacity) * sky_now + opacity * GetCloud(light_edit, sky_now, sun_now, view, opacity);
  vec3 plain = GetRatio(sky_now, sky_before);
  vec3 veiled = GetRatio(veil_now, veil_before);
  vec3 ratio = plain + cloud_strength * (veiled - plain);
  // Beyond 8x (or an eighth) noise and clipping would be amplified: trust the model there.
  float extreme = smoothstep(2.5, 4.0, abs(log2(GetLuminance(ratio) * gain)));
  vec3 relit = sky * ratio;
  relit += extreme * moved * (clean * ratio - relit);
  vec3 sky_out = scene + sky_strength * (gain * relit - scene);

  // The new disc, reddened on its way, behind clouds; the matte hides it behind land.
  float pixel_angle = 1.0 / (camera_focal * frame_size.y);
  vec4 disc = GetSunDiscRadiance(columns, view, sun_now, altitude, sun_size, pixel_angle);
  float clear = (1.0 - opacity) * (1.0 - opacity);
  sky_out += moved * sky_strength * clear * gain * sky_gain * max(SpectralToRec709(disc), vec3(0.0));

  // Land: ratio of irradiances, with the visible share of the disc. What rises above the
  // horizon stands upright.
  float visible_before = texelFetch(visibility_source, ivec2(0), 0).r;
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;
  float upright = smoothstep(-0.005, 0.02, view.y);
  float facing_before = mix(source_land_facing, 1.0, upright * 0.8);
  float facing_now = mix(land_facing, 1.0, upright * 0.8);
  vec3 irradiance_before = GetLandIrradiance(light_source, visible_before, facing_before, sun_before);
  vec3 irradiance_now = GetLandIrradiance(light_edit, visible_now, facing_now, sun_now);
  vec3 land_ratio = GetRatio(irradiance_now, irradiance_before);
  // What exceeds white paint in this light is a mirror image of the sky and the sun (water, wet
  // road, glass): that part follows what it mirrors, the rest is lit as land.
  float white = GetLuminance(sky_gain * irradiance_before) / 3.14159265;
  float mirror = 1.0 - min(white / max(GetLuminance(scene), 1e-6), 1.0);
  mirror = max(mirror, ReadPicture(surface, place).g);
  if (mirror > 0.0) {
    // Waves tilt: what they mirror lies somewhat above the exact reflection.
    vec3 up = normalize(vec3(view.x, abs(view.y) + 0.1, view.z));
    vec3 glint_before = sky_gain * visible_before * GetLightTexel(light_source, 1);
    vec3 glint_now = sky_gain * visible_now * GetLightTexel(light_edit, 1);
    vec3 mirrored = GetRatio(
        GetMirrorRadiance(GetMatchedSky(sky_view_edit, up), glint_now, sun_now, view),
        GetMirrorRadiance(GetMatchedSky(sky_view_source, up), glint_before, sun_before, view));
    // A clipped glint does not say how bright it was: let it fade freely, but hardly grow.
    land_ratio += mirror * (min(mirrored, vec3(2.0)) - land_ratio);
  }
  vec3 land = scene * land_ratio;
  float hidden = clamp(visible_before - visible_now, 0.0, 1.0) * colourfulness;
  land += hidden * (vec3(GetLuminance(land)) - land) * 0.5;
  vec3 land_out = scene + land_strength * (gain * land - scene);

  // Written as differences, so that what did not change adds exactly nothing.
  vec3 out_scene = scene + layer.r * (sky_out - scene) + (1.0 - layer.r) * (land_out - scene);
  WriteFrame(display, GetDisplayLight(out_scene) - GetDisplayLight(scene), pixel);
}
