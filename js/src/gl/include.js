/**
 * Expands includes. The kernel's twin is `sunwidget/renderer/shader_source.py`; a test
 * asserts that both expand every pass to the same text.
 */

const INCLUDE = /^[ \t]*#include "([^"]+)"[ \t]*$/gm;

/**
 * Return the text of a shader with every `#include` expanded. A file is expanded where it is
 * first mentioned and dropped at later mentions.
 *
 * @param {Record<string, string>} files text by path, relative to `shaders/`
 * @param {string} path
 * @param {Set<string>} seen
 * @returns {string}
 */
export function resolveIncludes(files, path, seen = new Set([path])) {
  const text = files[path];
  if (text === undefined) throw new Error(`There is no shader file "${path}".`);
  return text.replace(INCLUDE, (_line, /** @type {string} */ name) => {
    if (seen.has(name)) return "";
    seen.add(name);
    return resolveIncludes(files, name, seen);
  });
}
