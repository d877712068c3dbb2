// The frame for pixels of sky alone, away from the old sun's glare (frame_parts.glsl).

#define SKY_ALONE
#include "frame/frame.glsl"
