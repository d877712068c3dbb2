// What all pixels of sky.glsl share.

#define PHOTOS_OWN_LIGHT
#include "sky/describe_sky.glsl"

void SetConstants() {
  SetDescribedSky();
}
