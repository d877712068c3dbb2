// The light of the air in front of distant land, by column of the picture: that of an endless path along
// the horizon, in the photo's scene-linear unit. Around a sun hidden by land or clouds the near air lies in
// their shade, and is no brighter than air to the side of the sun.

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "frame/srgb.glsl"

uniform sampler2D sky_view;
uniform sampler2D visibility;
uniform float sun_azimuth;
uniform vec2 pass_size;

out vec4 result;

const float kLevel = 0.573;  // degrees above the horizon

void main() {
  vec3 view = GetViewDirection(vec2(gl_FragCoord.x / pass_size.x, 0.5));
  vec3 level = normalize(vec3(view.x, 0.01, view.z));
  vec3 lit = GetMatchedSky(sky_view, level);
  vec3 aside = GetMatchedSky(sky_view, GetSunDirection(sun_azimuth + 90.0, kLevel));
  vec3 shaded = GetLuminance(aside) < GetLuminance(lit) ? aside : lit;
  result = vec4(mix(shaded, lit, texelFetch(visibility, ivec2(0), 0).r), 1.0);
}
