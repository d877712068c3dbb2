// The next order of the precomputed sky, in each direction of the quadrature ("incident" in
// bruneton/field.glsl): radiance of that order's source along the direction, plus that of the
// ground under the previous order's light.

#include "bruneton/field.glsl"

out vec4 result;

void main() {
  IncidentRay ray = GetIncidentRay(ivec2(gl_FragCoord.xy));
  vec4 radiance = GatherSource(ray.h, ray.mu, ray.mu_s, ray.nu, ray.d, ray.ground, vec4(0.0));
  result = radiance / GetFading(ray.mu_s);
}
