// The picture, method "ratio": every term is a ratio new/old of one model at two suns, so an
// unmoved sun multiplies by exactly one. Where a ratio is meaningless (clipped pixels, the old
// disc and its halo, extreme ratios) the frame cross-fades to the matched model itself.
// Software rendering is memory-bound: a full-size map costs more than a dozen functions, so
// the sky at the moved sun is computed here and not read from a separate map.
//
// SKY_ALONE and LAND_ALONE omit the terms that are zero where the matte is 1 or 0
// (frame_parts.glsl); the picture stays the same to the bit.

#include "frame/picture.glsl"
#include "frame/packed.glsl"
#include "frame/strip.glsl"
#include "sky/relit_sky.glsl"
#include "land/relit_land.glsl"
#include "water/water.glsl"
#include "sky/disc.glsl"
#include "land/read_land_light.glsl"
#include "land/read_air.glsl"
#include "camera/night_vision.glsl"
#include "camera/read_veil.glsl"
#include "land/lamps.glsl"
#include "frame/frame_output.glsl"

uniform sampler2D retouched;
uniform sampler2D scene_light;
uniform sampler2D sky_source;
uniform sampler2D sky_behind;
uniform sampler2D own_sky;
uniform sampler2D mirror_ratio;
uniform sampler2D veil;
uniform sampler2D layers;
uniform float cover_of_low_sky;

const float kBlackestAlbedo = 0.06;
const vec2 kWhitish = vec2(0.45, 0.8);  // display-linear light of the darkest channel

// Share of a pixel's light that is sky. Where the matte is soft a pixel shows both, and twigs
// in front of a bright sky are mostly sky: the light behind is known (sky_behind.glsl), and the rest is
// the land's own, without the old sky's tint. Inside the sky the share is the matte itself, as it is
// where the matte implies more sky than the pixel holds (it is wrong there) and in the glare. No land is black under its
// irradiance, `lit`: otherwise a slightly wrong matte would leave a dark line along the skyline.
vec3 GetSkyShare(float matte, vec3 scene, vec3 behind, float glare, vec3 lit) {
  vec3 least = min((1.0 - matte) * kBlackestAlbedo / 3.14159265 * lit, (1.0 - matte) * scene);
  vec3 light = min(matte * behind, scene - least);
  float excess = matte * GetLuminance(behind) / max(GetLuminance(scene), 1e-6);
  float plain = max(smoothstep(0.85, 1.0, matte), smoothstep(0.9, 1.6, excess));
  return mix(min(light / max(scene, vec3(1e-6)), vec3(1.0)), vec3(matte), max(plain, glare));
}

// Near white a step of a channel is a leap of light, and compression and clipping have changed its hue: as the picture
// changes by `share`, such light keeps the hue that the picture shows.
vec3 GetWhitesHue(vec3 scene, vec3 display, float share) {
  vec3 color = display * (GetLuminance(scene) / max(GetLuminance(display), 1e-6));
  return mix(scene, color, share * smoothstep(kWhitish.x, kWhitish.y, min(min(display.r, display.g), display.b)));
}

void main() {
  vec2 pixel = GetPixel();
  vec2 place = pixel / frame_size;
  ivec2 texel = ivec2(pixel - tile_origin);
  vec3 view = GetViewDirection(place);
  vec3 display = texelFetch(retouched, texel, 0).rgb;
  vec4 behind_texel = texelFetch(sky_behind, texel, 0);
  vec3 sky_marks = UnpackLevels(behind_texel.a);
  vec3 clean = behind_texel.rgb;
#ifndef LAND_ALONE
  vec4 own = ReadBilinear(own_sky, place);
#endif
#ifdef SKY_ALONE
  // Three powers cost less than reading a map that nothing else here needs.
  vec3 scene = GetSceneLight(display);
#else
  vec4 scene_texel = texelFetch(scene_light, texel, 0);
  vec3 scene = scene_texel.rgb;
  vec3 land_marks = UnpackLevels(scene_texel.a);
#endif
#if defined(SKY_ALONE)
  const float matte = 1.0;
#elif defined(LAND_ALONE)
  const float matte = 0.0;
#else
  float matte = sky_marks.r;
#endif
  float strength = mix(land_strength, sky_strength, matte);
  vec3 light = GetWhitesHue(scene, display, GetMoved() * min(strength, 1.0));

  // The pixel's sky and land, each as if it filled the pixel.
  float glare = sky_marks.b;
#if defined(SKY_ALONE)
  vec3 behind = light;
#elif defined(LAND_ALONE)
  const float nearby = 0.0;
  vec3 front = light;
#else
  float nearby = own.b * step(1e-3, matte);
  vec3 share = GetSkyShare(matte, light, clean, glare, GetIrradianceBefore(GetUprightness(view)));
  vec3 behind = matte == 1.0 ? light : light * share / max(matte, 1e-4);
  vec3 front = light * (1.0 - share) / max(1.0 - matte, 1e-4);
#endif

  vec3 change = light - scene;
  float uneven = 0.0;
#ifndef LAND_ALONE
  vec3 sky_before = texelFetch(sky_source, texel, 0).rgb;
  // An unchanged sky stays the same to the bit, even if two programs round the same formula differently.
  vec3 sky_now = mix(GetDescribedSky(view), sky_before, bvec3(IsSkyUnchanged()));
  float opacity = min(sky_marks.g / max(matte, 1.0 / 255.0), 1.0);  // of the sky's share
  // A border in haze is wide; land hides the disc all the same.
  vec3 disc = smoothstep(0.2, 0.8, matte) * GetDisc(view, GetDescribedSun());
  change += matte * sky_strength
      * GetSkyChange(behind, clean, opacity, glare, own, sky_before, sky_now, view, disc, uneven);
#endif

#ifndef SKY_ALONE
  float wet = smoothstep(0.2, 0.8, land_marks.r);  // the edge of a mask is softer than a shore
  float water = GetSkySeen() * water_strength * wet;  // without a sky what it mirrors is unknown
  float upright = GetUprightness(view);
  vec3 lit_before = GetIrradianceBefore(upright);
  float removed = glare * GetMoved() * (1.0 - wet);
  vec3 land = RemoveGlare(front, removed, lit_before, nearby);
  removed = min(removed, max(1.0 - GetLuminance(land) / max(GetLuminance(front), 1e-6), 0.0));
  // Land that is bright without a sun in front is snow, sand or foam.
  float shine = sun_visible * GetSkySeen() * (1.0 - upright / kMostUpright)
      * GetMirrorShare(land, lit_before, land_marks.g);
  vec4 mirror = ReadBilinear(mirror_ratio, place);
  vec3 land_ratio = GetLandLight(place, land_marks.b);
  int column = GetAirColumn(place);
  vec3 horizon = GetHorizon(column);
  vec3 land_change = GetLandChange(front, land, land_ratio, GetIrradianceNow(upright), shine, mirror.rgb, removed,
                                   min(9.0 * matte, 1.0));
  // Only what is certainly water glints. What mirrors land does not, and changes as land where it would become brighter.
  float mirrored = UnpackSecond(scene_texel.a);
  mirror.a *= smoothstep(0.5, 0.95, land_marks.r) * (1.0 - mirrored);
  vec3 water_change = GetWaterChange(view, front, clean, land_marks.g, glare, mirror, horizon);
  float brighter = GetLuminance(water_change - land_change) / max(GetLuminance(front + land_change), 1e-6);
  water *= 1.0 - mirrored * smoothstep(0.0, 0.3, brighter);
  land_change += water * (water_change - land_change);
  land_change += GetExposureGain()
      * GetLampLight(place, 3.14159265 * GetLuminance(land) / max(GetLuminance(lit_before), 1e-6));
  if (!IsSkyUnchanged()) {
    // Fog and haze are air, lit as the sky at the horizon. Water mirrors it all the same.
    float air = ReadPixel(layers, place).a;
    float airy = (1.0 - water) * GetAirShare(air);
    if (airy > 0.0) {
      float even;
      vec3 level = normalize(vec3(view.x, kLevelAir, view.z));
      vec3 air_change = GetSkyChange(land, land, cover_of_low_sky, 0.0, ReadBilinear(own_sky, place),
          texelFetch(air_source, ivec2(column, 0), 0).rgb, texelFetch(air_edit, ivec2(column, 0), 0).rgb, level,
          vec3(0.0), even);
      land_change += airy * (land_strength * (air_change + land - front) - land_change);
    }
    land_change += land_strength
        * GetHazeChange(GetExposureGain() * horizon, land_marks.b, front + land_change, air);
  }
  change += (1.0 - matte) * land_change;
#endif

  change += GetVeil(scene + change, view, ReadBilinear(veil, place), matte, uneven);
  change += strength * GetNight() * GetRodShift(scene + change);
  // Sky filled in where the old sun hid it gets the photo's grain.
#ifdef LAND_ALONE
  const float filled = 0.0;
#else
  float filled = matte * glare * GetMoved() * min(sky_strength, 1.0);
#endif
  WriteChange(display, scene, change, filled, pixel);
}
