// Light that the camera and the air in between add over the whole picture: light shafts and lens flare of
// the new sun. Soft, so a quarter of the size is enough; the new sun's glare is too sharp for that
// (camera/read_veil.glsl), but a is the share of it that passes the clouds.

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
uniform sampler2D backdrop;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float light_shafts;
uniform float lens_flare;
uniform vec2 pass_size;

out vec4 result;

// Longer sides of the picture between nine taps: on the cloud alone, without the photo's grain, and on what is around.
const float kAlone = 0.003;
const float kAround = 0.04;
const float kStops = 1.11;  // in nine codes of the backdrop
// Stops of blue over red from which the surroundings may be blue sky, and are.
const vec2 kMaybeBlue = vec2(0.3, 0.7);
// Power of the clouds' light by which they darken the glare (more than brighten it, or they burn), and the stops to which
// that light is bounded.
const float kDarkens = 4.0;
const float kMostUneven = 1.2;

// The share of the glare that passes gray clouds here, relative to those around: the brighter, the thinner they are. Of
// white clouds in blue sky the reverse is true, so none counts, and before a low sun they look wrong. The backdrop's
// code is a logarithm with a floor, which keeps the noise of the dark low.
float GetPassing(vec2 place) {
  vec3 alone = vec3(0.0);
  vec3 around = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    vec2 aside = (vec2(i / 3, i % 3) - 1.0) * max(frame_size.x, frame_size.y) / frame_size;
    alone += ReadBilinear(backdrop, place + kAlone * aside).rgb;
    around += ReadBilinear(backdrop, place + kAround * aside).rgb;
  }
  float gray = 1.0 - smoothstep(kMaybeBlue.x, kMaybeBlue.y, kStops * (around.b - around.r));
  float uneven = texelFetch(composite_constants, ivec2(kBesideSun, 0), 0).w * gray
      * clamp(kStops * GetLuminance(alone - around), -kMostUneven, kMostUneven);
  return exp2(min(kDarkens * uneven, uneven));
}

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec4 first = texelFetch(composite_constants, ivec2(kGains, 0), 0);
  // Each channel's gain was fitted to the sky and contains that sky's own tint; added light has
  // the sun's color and the gain of all three.
  vec3 beam = GetLuminance(sky_gain) * GetLightScale(GetMoon()) * GetLightTexel(light_edit, 1);
  // The photo's own shafts and flare are unknown and stay in place. The new ones fade in as the sun moves.
  float shafts = light_shafts * ReadBilinear(shafts_edit, place).r;
  vec3 at = GetPlaceOfDirection(GetSunDirection(sun_azimuth, sun_elevation));
  vec2 scale_of_place = vec2(frame_size.x / frame_size.y, 1.0);
  float flaring = lens_flare * texelFetch(visibility_edit, ivec2(0), 0).r * step(0.0, at.z);
  vec3 flare = flaring * GetFlare((place - 0.5) * scale_of_place, (at.xy - 0.5) * scale_of_place);
  result = vec4(first.x * first.y * (shafts + flare) * beam, GetPassing(place));
}
