// Values shared by all pixels of explorer_frame.glsl: the sky's description and the exposure.

#include "atmosphere/read_sky_view.glsl"

uniform sampler2D shown;
uniform sampler2D adaptation;

flat out vec4 described[4];
flat out vec4 adapted;
flat out vec4 scales;

void SetConstants() {
  // Both views of `shown` end with the same description.
  SkyView view = ReadSkyView(shown);
  described[0] = vec4(view.sun, view.asymmetry);
  described[1] = view.rayleigh;
  described[2] = view.mie;
  described[3] = vec4(view.horizon);
  adapted = texelFetch(adaptation, ivec2(0), 0);
  scales = texelFetch(adaptation, ivec2(1, 0), 0);
}
