// What all pixels of the frame share: terms.glsl, and the sky at the moved sun.

#include "lib/describe_sky.glsl"

uniform sampler2D terms;

flat out vec4 term[11];

void SetConstants() {
  for (int i = 0; i < 11; ++i) term[i] = texelFetch(terms, ivec2(i, 0), 0);
  SetDescribedSky();
  // Two texels more would be more than a vertex may hand over; of these only the alphas are asked for.
  described[3].zw = vec2(texelFetch(terms, ivec2(11, 0), 0).a, texelFetch(terms, ivec2(12, 0), 0).a);
}
