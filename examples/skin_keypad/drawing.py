"""How the keypad looks in a terminal: a pure function of a snapshot."""

from egotouch_sdk.skin import SkinKeypad, SkinSnapshot, ViewSnapshot

PLAIN, HOVERED = "48;5;236", "4;48;5;242"
#: From a touch to a hard press, 3.5 N (the most that the touch model tells apart).
PRESSED = ("30;48;5;193", "30;48;5;155", "30;48;5;118", "30;48;5;76")
FULL_FORCE_N = 3.5


def draw(keypad: SkinKeypad, snapshot: SkinSnapshot, number: str) -> str:
    """The number over rows of keys: grey, underlined under a hovering finger, the greener the harder they are pressed."""
    lines = [f"  {number or 'dial a number':<40}", ""]
    for row in keypad.rows:
        cells = [_cell(key, snapshot.view(keypad.button_name(key))) for key in row]
        lines += ["  " + " ".join(cell[part] for cell in cells) for part in range(2)]
    touching = next((view for view in snapshot.views if view.is_pressed), None)
    return "\n".join([*lines, "", f"  {f'{touching.force_n:.1f} N on {touching.text}' if touching else '':<20}"])


def _cell(key: str, look: ViewSnapshot) -> tuple[str, str]:
    style = HOVERED if look.is_hovered else PLAIN
    if look.is_pressed:
        style = PRESSED[min(int(look.force_n / FULL_FORCE_N * len(PRESSED)), len(PRESSED) - 1)]
    return tuple(f"\x1b[{style}m{text:^7}\x1b[0m" for text in (key, ""))
