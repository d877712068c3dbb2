/** Paths per pixel after which the reference stops: a picture as clean as eight bits can show. */
export const MOST_SAMPLES = 512;
