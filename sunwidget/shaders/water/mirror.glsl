// The reflection in level water (or a wet road) at each place below the horizon: rgb the sky, a the
// sun's glints per unit of its light (water/glint.glsl). It varies slowly, so a quarter of the size is enough.

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "water/glint.glsl"

uniform sampler2D sky_view;
uniform vec2 pass_size;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float wind_speed;
uniform float wind_direction;

out vec4 result;

void main() {
  vec3 view = GetViewDirection(gl_FragCoord.xy / pass_size);
  view.y = min(view.y, -0.002);
  // The visible facets lean towards the viewer and mirror the sky above the exact reflection.
  float facing = GetFacing(view, wind_speed);
  vec3 up = normalize(vec3(view.x, facing, view.z));
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  result = vec4(GetFresnel(facing) * GetMatchedSky(sky_view, up),
                GetGlint(sun, view, wind_speed, wind_direction));
}
