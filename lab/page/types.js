// @ts-check
/**
 * The page's requests to the core and the core's answers: JSON in both directions, one answer per request.
 *
 * Numbers are in SI and have their units in their names. A number for display is a {@link Shown}: its `text` is
 * what the program prints for it. The page itself writes differences and values read off a curve. Places count from
 * the knob end. The page keeps track of times, numbers of requests and what is certified: the core keeps nothing
 * between two requests.
 */

/**
 * A number with the text that the program shows for it, in the units of the request.
 * @typedef {{ value: number, text: string }} Shown
 */

/**
 * A place on the bat.
 * @typedef {{ x_m: number, text: string, from_tip: string }} Place
 */

/**
 * Every request has these members; others depend on `ask`.
 * @typedef {object} Request
 * @property {number} id        returned in the answer
 * @property {Ask} ask
 * @property {string} bat       the text of a bat file; for `open` also a CSV table of stations
 * @property {Scene} [scene]    options of `sweetspot hit`; an omitted one has its default
 * @property {"si" | "us"} [units] of every text in the answer (default si)
 */

/** @typedef {"open" | "trace" | "body" | "live" | "sure" | "analyze" | "lathe" | "sound" | "tap" | "aim" | "files"} Ask */

/**
 * The options of `sweetspot hit` with `_` for `-`; a string carries its unit ("72 mph"), a number is SI.
 * @typedef {object} Scene
 * @property {number | string} [swing_speed]   angular speed, in place of `bat_speed`
 * @property {number | string} [bat_speed]     speed of the point `bat_speed_at` from the tip
 * @property {number | string} [bat_speed_at]  6 in by default
 * @property {number | string} [pivot]
 * @property {number | string} [pitch]
 * @property {"baseball" | "humid-baseball" | "softball"} [ball]
 * @property {number | string} [ball_stiffness]
 * @property {number} [cor]
 * @property {number | string} [hands]
 * @property {number | string} [reference_inertia]  "same batter": swing weight of the bat with the given swing …
 * @property {number} [swing_exponent]              … and the power by which the swing slows with it
 */

/**
 * The mistakes in words with their places. `line` and `column` count from 1; they exist if the mistake is in the
 * text of `bat`. `panic`: an internal error; the instance must be discarded.
 * @typedef {{ id: number, error: string, mistakes?: Mistake[], panic?: true }} Failed
 */

/** @typedef {{ text: string, line?: number, column?: number }} Mistake */

/**
 * `open`: the bat as the page edits it. Read as a bat file it is the same bat, except for `differs`.
 * @typedef {object} Opened
 * @property {number} id
 * @property {BatFile} bat
 * @property {string} bat_file        the text of it
 * @property {string | null} differs  the change due to conversion to stations, in a sentence with numbers; null if none
 * @property {string[]} parts         regions, attachments, supports and edits that stay, in words
 * @property {string[]} warnings      unusual properties of the bat
 */

/**
 * A bat file whose profile is a table of stations. `unit` is "in" or "mm", and every number of the profile is in it.
 * The diameter steps where two stations have the same `x`. All other members of a bat file stay unchanged.
 * @typedef {object} BatFile
 * @property {"sweetspot-bat/1"} format
 * @property {string} name
 * @property {object | string} material
 * @property {{ unit: "in" | "mm", interpolation: "pchip" | "linear", x: number[], diameter: number[],
 *              inner_diameter?: number[] }} profile
 * @property {object[]} [edits]
 */

/**
 * `body`: figures of the rigid bat, in the frame.
 * @typedef {object} Body
 * @property {number} id
 * @property {string} name
 * @property {boolean} inches        whether its file is in inches
 * @property {boolean} hollow        whether the wall of its barrel may ring
 * @property {boolean} stations      whether its profile is a table of stations, as in {@link BatFile}
 * @property {{ x_m: number[], radius_m: number[], inner_m: number[] }} outline  including the edits
 * @property {Shown} length
 * @property {Shown} mass
 * @property {Shown} balance
 * @property {Shown} swing_weight
 * @property {Shown} drop            ounces less inches
 * @property {Shown} widest          largest diameter
 * @property {string[]} fixtures     the fixtures and supports of the bat, before its edits
 * @property {string[]} edits        one for each edit of the file, in their order
 * @property {string[]} warnings
 */

/**
 * A bending mode. `note` is the nearest note and the difference in cents: "F3 +12".
 * @typedef {{ order: number, frequency: Shown, note: string, nodes: Place[] }} ModeShown
 */

/**
 * The hit along the barrel: null where ball and bat do not meet. `stiff_m_s`: without bending, only in `sure`.
 * @typedef {{ x_m: number[], exit_m_s: (number | null)[], stiff_m_s?: (number | null)[],
 *             vibration_j: (number | null)[] }} Curve
 */

/**
 * `live` and `sure`: modes and hits. `live` is a preview (10 modes to 1e-3, 21 places or more, the wall of a
 * hollow barrel as an estimated spring); `sure` is the answer of `sweetspot hit`, with equal texts.
 * @typedef {object} Hit
 * @property {number} id
 * @property {boolean} certified     only in `sure`, if the requested accuracy was reached
 * @property {string | null} unmet   why it was not reached, in words
 * @property {boolean} rough_wall    whether a compliant wall is taken as an estimated spring
 * @property {ModeShown[]} modes     the first three
 * @property {Curve} curve
 * @property {{ place: Place, speed: Shown } | null} best  the sweet spot by the fastest ball
 * @property {[Place, Place] | null} zone  within 1 % of it
 * @property {Shown | null} vibration  energy left in vibration at the sweet spot
 * @property {{ what: string, place: Place }[]} spots     every definition of the sweet spot (`sure`)
 * @property {string[]} doubts       reasons for doubt (`sure`)
 */

/**
 * `analyze` has also `diameter_deviation_m`, that of traced diameters: the answers of `sweetspot analyze`, each with
 * its uncertainty for the bat in hand (two bats in three), and with the wall of a hollow barrel. Slow: a second for
 * wood, several for a hollow bat.
 * @typedef {object} Analyzed
 * @property {number} id
 * @property {{ what: string, value: Shown, open: string, by: string }[]} answers  the lines of its table
 * @property {{ what: string, text: string }[]} figures   as `hit --full` lists them
 * @property {string | null} why     the reason for the place of the sweet spot
 * @property {string[]} trust        the reliability of the answers, in sentences
 * @property {{ hoop: { frequency: Shown, note: string }[], words: string[] } | null} barrel  of a hollow bat
 */

/**
 * `lathe`: the effect of a millimetre off the diameter (1/32 in), band by band along the bat, by its derivative.
 * @typedef {object} Lathe
 * @property {number} id
 * @property {string} depth          the depth of the cut: "mm" or "1/32 in"
 * @property {{ from_m: number, to_m: number }[]} bands
 * @property {{ what: string, changes: (Shown | null)[] }[]} effects  a change for every band
 * @property {string[]} strongest    in sentences
 */

/**
 * `sound` has also `x_m`, `blow` ("tap": a knock, "finger": soft, "ball": the scene's hit) and `held` ("free" or
 * "hands": held as by a grip). Play `Σ a e^(−d t) sin(2π f t) / loudest_m_s2`: a place on a node is quieter.
 * @typedef {object} Sound
 * @property {number} id
 * @property {{ frequency_hz: number, decay_1_s: number, amplitude_m_s2: number }[]} tones
 * @property {number} loudest_m_s2   of such blows anywhere on the barrel
 * @property {string | null} assumed  the assumption about the damping, in words
 */

/**
 * `tap` has also `name`, `rate_hz`, `channels` and the number of `lost` pieces of a sound whose samples follow the
 * request after a byte 0: channel after channel, four bytes each, the lowest first. The loudest channel is used. Modes
 * given by the user are in `told`: pairs of a tone's frequency (Hz) and its bending mode, or null for no mode.
 * @typedef {object} Tapped
 * @property {number} id
 * @property {object} document       that of `sweetspot tap --json`
 * @property {string} heard          taps and rate
 * @property {{ frequency: string, note: string, loss: string, is: string, sure: string,
 *              computed: { frequency: Shown, note: string } | null }[]} tones  the lines of its table
 * @property {string | null} wood    the material of the bat
 * @property {string[]} words        defects of the recording, with advice
 * @property {string | null} bat_file  the text of the bat of that wood
 * @property {number} most_modes     the highest bending mode that can be given
 */

/**
 * `aim` has also `targets`, texts in the notation of `sweetspot aim --target` ("1 oz lighter", "keep pop", "drop 3",
 * "sweet spot 1 cm outward"), and `remove_only`.
 * @typedef {object} Aimed
 * @property {number} id
 * @property {boolean} met
 * @property {string} bat_file       the text of the new bat's file, with a profile as in {@link BatFile}
 * @property {string} text           the changes, their cost, and the targets that conflict
 */

/**
 * `files` has also `name`, that of the bat file on disk (default bat.json).
 * @typedef {object} Files
 * @property {number} id
 * @property {string} bat_file       the text of the bat file
 * @property {string} csv            the stations as a table
 * @property {string[]} template     pages in true size, SVG (A4 for millimetres, letter for inches)
 * @property {string} command        the command line that prints the same numbers
 */

/**
 * `trace` has no `bat`; it has `width` and `height` of a picture whose RGBA bytes follow the request after a byte
 * 0, `length_m`, `diameter_m` (the largest), `material`, `pins` (places on its edges set by hand, px), `others` (what
 * other pictures gave in `seen`), and if they are known `mass_kg` and `distance_m`.
 * @typedef {object} Traced
 * @property {number} id
 * @property {object} seen           the result of this picture
 * @property {number[][][]} edges    two lines of places (px)
 * @property {number[][]} ends       the two ends (px)
 * @property {string} bat_file       of the mean of all pictures
 * @property {number} stations
 * @property {number} pictures
 * @property {number} diameter_deviation_m  standard deviation of a diameter
 * @property {string} deviation      the same in words
 * @property {string[]} words        limits of the result
 */

export {};
