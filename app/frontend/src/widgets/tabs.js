// A click on a tab is answered here, at once; the message with its view comes later, behind what is on its way already.
/** @param {{ places: string[] }} given the names of the places, in turn */
export function turnTab({ places }, tabs) {
  places.forEach((name, i) => tabs.document.get_model_by_name(name)?.setv({ visible: i === tabs.active }, { sync: false }));
}
