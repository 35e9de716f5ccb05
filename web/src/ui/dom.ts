// Elements in few words.

type Properties = Record<string, unknown>;
type Child = Node | string | null | undefined | false;

// `on...` properties are listeners; names with a dash and `role` are attributes; the others are set on the element.
export function h<K extends keyof HTMLElementTagNameMap>(
	tag: K,
	properties: Properties = {},
	...children: Child[]
): HTMLElementTagNameMap[K] {
	const element = document.createElement(tag);
	for (const [name, value] of Object.entries(properties)) {
		if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
		else if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, String(value));
		else (element as any)[name] = value;
	}
	element.append(...children.filter((child): child is Node | string => Boolean(child)));
	return element;
}

// A number as people write it: three or four digits, powers of ten where there are many zeros.
export function format(value: number, digits = 3): string {
	if (!Number.isFinite(value)) return "–";
	if (value === 0) return "0";
	const size = Math.abs(value);
	if (size >= 1e5 || size < 1e-3) return Number(value.toPrecision(digits)).toExponential().replace("e+", "e");
	return String(Number(value.toPrecision(digits)));
}
