// The sky without the old sun, where clouds are unedited (cloud_parts.glsl).

#define CLOUDS_UNEDITED
#include "sky/sky_behind.glsl"
