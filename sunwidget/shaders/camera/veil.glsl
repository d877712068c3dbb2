// Light that the camera and the air in between add over the whole picture: light shafts and lens flare of
// the new sun. Soft, so a quarter of the size is enough; the new sun's glare is too sharp for that
// (camera/read_veil.glsl).

#include "frame/picture.glsl"
#include "frame/composite_texels.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"
#include "frame/srgb.glsl"
#include "camera/flare.glsl"

uniform sampler2D composite_constants;
uniform sampler2D light_edit;
uniform sampler2D visibility_edit;
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
  vec3 beam = GetLuminance(sky_gain) * GetLightScale(GetMoon()) * GetLightTexel(light_edit, 1);
  // The photo's own shafts and flare are unknown and stay in place. The new ones fade in as the sun moves.
  float shafts = light_shafts * ReadBilinear(shafts_edit, place).r;
  vec3 at = GetPlaceOfDirection(sun_now);
  vec2 scale_of_place = vec2(frame_size.x / frame_size.y, 1.0);
  float flaring = lens_flare * visible_now * step(0.0, at.z);
  vec3 flare = flaring * GetFlare((place - 0.5) * scale_of_place, (at.xy - 0.5) * scale_of_place);
  result = vec4(first.x * first.y * (shafts + flare) * beam, 0.0);
}
