// One colour a quantity: app/model/colours.json is the one list, for Python too.
import colours from "../../model/colours.json" with { type: "json" };

export { colours };
