// Water away from the old sun's glints (water_parts.glsl): its light is its own.

#define NO_GLINTS
#include "water/water_behind.glsl"
