// Everything of the ratio composite that is the same for all pixels, so that no pixel computes
// it again. Texels:
//   0  exposure gain, how far the sun has moved (0..1), colour lost in shade, unused
//   1  light on lying land before     2  on upright land before     3, 4  the same now
//   5  light of a cloud before        6  what its forward lobe adds, before     7, 8  now
//   9  direction of the sun before   10  now
//  11, 12  right and up of the disc's picture, divided by its reach
//  13  the sun's light on water before   14  now

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/daylight.glsl"
#include "lib/disc_patch.glsl"

uniform sampler2D light_source;
uniform sampler2D light_edit;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform sampler2D meter_source;
uniform sampler2D meter_edit;
uniform vec2 tile_origin;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform float land_facing;
uniform float source_land_facing;
uniform float colourfulness;
uniform float exposure;
uniform float auto_exposure;

out vec4 result;

// Over this many degrees of movement the old sun's glare gives way to the sky behind it: long
// enough that a pixel's drag shows no step, short enough that a moved sun leaves no ghost.
const float kGlareFade = 4.0;

void main() {
  int index = int(gl_FragCoord.x + tile_origin.x);
  vec3 sun_before = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  float visible_before = texelFetch(visibility_source, ivec2(0), 0).r;
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;
  vec3 term;
  if (index == 0) {
    float stops = exposure + auto_exposure * (texelFetch(meter_source, ivec2(0), 0).r - texelFetch(meter_edit, ivec2(0), 0).r);
    float turn = degrees(2.0 * asin(min(0.5 * length(sun_now - sun_before), 1.0)));
    float hidden = clamp(visible_before - visible_now, 0.0, 1.0);
    term = vec3(exp2(stops), smoothstep(0.0, kGlareFade, turn), 0.5 * hidden * colourfulness);
  } else if (index == 1) {
    term = sky_gain * GetLandIrradiance(light_source, visible_before, source_land_facing, sun_before);
  } else if (index == 2) {
    term = sky_gain * GetLandIrradiance(light_source, visible_before, 1.0, sun_before);
  } else if (index == 3) {
    term = sky_gain * GetLandIrradiance(light_edit, visible_now, land_facing, sun_now);
  } else if (index == 4) {
    term = sky_gain * GetLandIrradiance(light_edit, visible_now, 1.0, sun_now);
  } else if (index == 5) {
    term = sky_gain * GetCloudRadiance(light_source, 0.0);
  } else if (index == 6) {
    term = sky_gain * (GetCloudRadiance(light_source, 1.0) - GetCloudRadiance(light_source, 0.0));
  } else if (index == 7) {
    term = sky_gain * GetCloudRadiance(light_edit, 0.0);
  } else if (index == 9) {
    term = sun_before;
  } else if (index == 10) {
    term = sun_now;
  } else if (index == 11) {
    term = GetDiscRight() / GetDiscReach();
  } else if (index == 12) {
    term = GetDiscUp() / GetDiscReach();
  } else if (index == 13) {
    term = sky_gain * visible_before * GetLightTexel(light_source, 1);
  } else if (index == 14) {
    term = sky_gain * visible_now * GetLightTexel(light_edit, 1);
  } else {
    term = sky_gain * (GetCloudRadiance(light_edit, 1.0) - GetCloudRadiance(light_edit, 0.0));
  }
  result = vec4(term, 0.0);
}
