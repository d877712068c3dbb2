// Light that the camera and the air in between add over the whole picture: light shafts and lens flare of
// the new sun minus those of the photo's own. Soft, so a quarter of the size is enough; the new sun's glare
// is too sharp for that (camera/read_veil.glsl).

#include "frame/picture.glsl"
#include "frame/composite_texels.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"
#include "frame/srgb.glsl"
#include "camera/flare.glsl"

uniform sampler2D composite_constants;
uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D visibility_edit;
uniform sampler2D shafts_source;
uniform sampler2D shafts_edit;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float light_shafts;
uniform float lens_flare;
uniform vec2 pass_size;

out vec4 result;

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec4 first = texelFetch(composite_constants, ivec2(kGains, 0), 0);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;
  // Each channel's gain was fitted to the sky and contains that sky's own tint; added light has
  // the sun's color and the gain of all three.
  float gain = GetLuminance(sky_gain);
  vec3 beam_before = gain * GetLightTexel(light_before, 1);
  vec3 beam_now = gain * GetLightScale(GetMoon()) * GetLightTexel(light_edit, 1);

  // The old sun's shafts in the photo were relit with the land; remove them at their relit brightness.
  float relit = GetLuminance(texelFetch(composite_constants, ivec2(kLevelLandNow, 0), 0).rgb) / max(GetLuminance(texelFetch(composite_constants, ivec2(kLevelLandBefore, 0), 0).rgb), 1e-20);

  float shaft_before = ReadBilinear(shafts_source, place).r;
  float shaft_now = ReadBilinear(shafts_edit, place).r;
  vec3 shafts = max(shaft_now, 0.0) * beam_now - max(shaft_before, 0.0) * relit * beam_before;
  // Shadows in the haze may deepen. Where one disappears no light replaces it: the photo does not show that haze,
  // and a shadow often contains the black of a silhouette.
  shafts += min(min(shaft_now, 0.0) * beam_now - min(shaft_before, 0.0) * relit * beam_before, vec3(0.0));
  // Two occurrences of one formula need not agree to the bit.
  shafts = light_shafts * mix(shafts, vec3(0.0), bvec3(first.w < 0.0 && shaft_now == shaft_before));

  vec3 at = GetPlaceOfDirection(sun_now);
  vec2 scale_of_place = vec2(frame_size.x / frame_size.y, 1.0);
  // The photo's own flare is unknown and stays in place. The new one fades in as the sun moves.
  float flaring = lens_flare * first.y * visible_now * step(0.0, at.z);
  vec3 flare = flaring * beam_now * GetFlare((place - 0.5) * scale_of_place, (at.xy - 0.5) * scale_of_place);

  result = vec4(first.x * (shafts + flare), 0.0);
}
