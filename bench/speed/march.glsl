// The peer's sky: single scattering marched for every pixel, and from every step towards the sun.
// Follows atmosphere/atmosphere.glsl, of which it uses geometry, densities and phases, but no table.

uniform vec3 camera_right;  // the level world's axes in the camera's coordinates
uniform vec3 camera_up;
uniform vec3 camera_forward;
uniform float camera_focal;  // px
uniform vec2 frame_size;
uniform vec3 sun;
uniform float camera_height;  // m
out vec4 result;

const int kSteps = 32;
const int LIGHT_STEPS = 8;

vec4 MarchToSun(mat3x4 extinction, float h, float mu_s) {
  if (RayIntersectsGround(h, mu_s)) return vec4(0.0);
  float d = GetDistanceToTop(h, mu_s);
  vec3 column = vec3(0.0);
  for (int i = 0; i < LIGHT_STEPS; ++i) {
    float u = (float(i) + 0.5) / float(LIGHT_STEPS);
    column += GetDensity(GetAltitudeAlongRay(h, mu_s, d * u * u)) * 2.0 * d * u / float(LIGHT_STEPS);
  }
  return exp(-(extinction * column));
}

void main() {
  vec2 place = (gl_FragCoord.xy - 0.5 * frame_size) / camera_focal;
  vec3 ray = normalize(vec3(place, 1.0));  // in the camera: right, down, forward
  vec3 view = vec3(dot(ray, camera_right), dot(ray, camera_up), dot(ray, camera_forward));
  float h = camera_height;
  float r = kGroundRadius + h;
  float mu = view.y;
  float nu = dot(view, sun);
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  mat3x4 extinction = GetExtinctionCoefficients();
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float u = (float(i) + 0.5) / float(kSteps);
    float t = d * u * u;
    float dt = 2.0 * d * u / float(kSteps);
    float h_t = GetAltitudeAlongRay(h, mu, t);
    float mu_s = clamp((r * sun.y + t * nu) / (kGroundRadius + h_t), -1.0, 1.0);
    vec3 density = GetDensity(h_t);
    vec4 scattered = extinction[0] * density.x * RayleighPhase(nu)
        + extinction[1] * density.y * aerosol_albedo * MiePhase(aerosol_asymmetry, nu);
    vec4 lost = extinction * density;
    radiance += transmittance * scattered * MarchToSun(extinction, h_t, mu_s)
        * IntegrateTransmittance(lost, dt);
    transmittance *= exp(-lost * dt);
  }
  if (ground) {
    float mu_s = clamp((r * sun.y + d * nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * ground_albedo / kPi * max(mu_s, 0.0)
        * MarchToSun(extinction, 0.0, mu_s);
  }
  result = kSolarIrradiance * radiance;
}
