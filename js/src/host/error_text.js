/** What an error says, for a person to read. @param {unknown} error */
export const errorText = (error) => (error instanceof Error ? error.message : String(error));
