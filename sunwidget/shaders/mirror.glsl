// What a level rough mirror (water, wet road) shows at each place below the horizon: rgb the sky
// above it, a the sun's glint per unit of its light. Fresnel's share is left out: it cancels in
// a ratio. Slow, so a quarter of the size is enough.

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/daylight.glsl"

uniform sampler2D sky_view;
uniform vec2 pass_size;
uniform float sun_azimuth;
uniform float sun_elevation;

out vec4 result;

void main() {
  vec3 view = GetViewDirection(gl_FragCoord.xy / pass_size);
  view.y = min(view.y, -0.002);
  // Waves tilt: what they mirror lies somewhat above the exact reflection.
  vec3 up = normalize(vec3(view.x, 0.1 - view.y, view.z));
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  result = vec4(GetMatchedSky(sky_view, up), GetGlint(sun, view));
}
