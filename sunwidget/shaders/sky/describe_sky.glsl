// The description of one sky view (what a look-up needs besides its radiances), read once into a
// pass's constants for sky/described_sky.glsl.

#include "atmosphere/read_sky_view.glsl"
#include "sky/sun_behind_cloud.glsl"

uniform sampler2D sky_view;

flat out vec4 described[4];

void SetDescribedSky() {
  SkyView view = ReadSkyView(sky_view);
  described[0] = vec4(view.sun, 0.0);
  described[1] = view.rayleigh;
  described[2] = view.mie * GetShadedShare();
  described[3] = vec4(view.horizon, 0.0, 0.0, 0.0);
}
