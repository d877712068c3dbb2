/** Return an error's message. @param {unknown} error */
export const errorText = (error) => (error instanceof Error ? error.message : String(error));
