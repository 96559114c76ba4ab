// Finds elements of the page, which are in the shadow roots of many components.
/** @param {string} selector @param {ParentNode} root @returns {HTMLElement | null} the first visible one */
export function find(selector, root = document) {
  for (const element of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll("*"))) {
    if (element.matches(selector) && element.getClientRects().length) return element;
    const inside = element.shadowRoot && find(selector, element.shadowRoot);
    if (inside) return inside;
  }
  return null;
}
