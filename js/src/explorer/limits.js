/** Paths a pixel after which the reference rests: a picture as clean as eight bits can show. */
export const MOST_SAMPLES = 512;
