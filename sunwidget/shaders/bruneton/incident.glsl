// One more order of the precomputed sky, in each direction of the quadrature ("incident" in
// bruneton/field.glsl): what the source of that order sends along the direction, and the
// ground under the light of the order before.

#include "bruneton/field.glsl"

out vec4 result;

void main() {
  IncidentRay ray = GetIncidentRay(ivec2(gl_FragCoord.xy));
  vec4 radiance = GatherSource(ray.h, ray.mu, ray.mu_s, ray.nu, ray.d, ray.ground, vec4(0.0));
  result = radiance / GetFading(ray.mu_s);
}
