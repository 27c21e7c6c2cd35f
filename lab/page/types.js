// @ts-check
/**
 * What the page asks of the core, and what the core answers: JSON both ways, one answer a request.
 *
 * Numbers are SI and their units stand in their names. A number that is shown comes as {@link Shown}: its `text` is
 * what the program prints for it. Differences and what is read off a curve the page writes itself. Places count from
 * the knob end. Times, numbers of requests and what is certified are the page's business: the core keeps nothing
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
 * Every request has these members; `ask` says which others.
 * @typedef {object} Request
 * @property {number} id        comes back in the answer
 * @property {Ask} ask
 * @property {string} bat       the text of a bat file; for `open` also a CSV table of stations
 * @property {Scene} [scene]    as `sweetspot hit` has it; what is left out is the default there
 * @property {"si" | "us"} [units] of every text in the answer (default si)
 */

/** @typedef {"open" | "trace" | "body" | "live" | "sure" | "analyze" | "lathe" | "sound" | "tap" | "aim" | "files"} Ask */

/**
 * The options of `sweetspot hit` with `_` for `-`; a string carries its unit ("72 mph"), a number is SI.
 * @typedef {object} Scene
 * @property {number | string} [swing_speed]   angular speed, in place of `bat_speed`
 * @property {number | string} [bat_speed]     speed of the point `bat_speed_at` from the tip
 * @property {number | string} [bat_speed_at]  6 in unless told
 * @property {number | string} [pivot]
 * @property {number | string} [pitch]
 * @property {"baseball" | "humid-baseball" | "softball"} [ball]
 * @property {number | string} [ball_stiffness]
 * @property {number} [cor]
 * @property {number | string} [hands]
 * @property {number | string} [reference_inertia]  "same batter": the swing of a bat of that swing weight is known …
 * @property {number} [swing_exponent]              … and slows with this power of it
 */

/**
 * What is wrong, in words that say where. `line` and `column` count from 1 and are there if the mistake stands in the
 * text of `bat`. `panic`: a mistake of ours; the instance is to be thrown away.
 * @typedef {{ id: number, error: string, mistakes?: Mistake[], panic?: true }} Failed
 */

/** @typedef {{ text: string, line?: number, column?: number }} Mistake */

/**
 * `open`: the bat as the page edits it. Read as a bat file it is the same bat but for what `differs` says.
 * @typedef {object} Opened
 * @property {number} id
 * @property {BatFile} bat
 * @property {string} bat_file        the text of it
 * @property {string | null} differs  what changed by becoming stations, in a sentence with numbers; null if nothing did
 * @property {string[]} parts         regions, attachments, supports and edits that stay, in words
 * @property {string[]} warnings      what is strange of the bat
 */

/**
 * A bat file whose profile is a table of stations. `unit` is "in" or "mm", and every number of the profile is in it.
 * Where two stations have one `x` the diameter steps. What else a bat file may have stays as it was.
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
 * @property {boolean} inches        whether its file counts in inches
 * @property {boolean} hollow        whether the wall of its barrel may ring
 * @property {boolean} stations      whether its profile is a table of stations as {@link BatFile} has it
 * @property {{ x_m: number[], radius_m: number[], inner_m: number[] }} outline  edits and all
 * @property {Shown} length
 * @property {Shown} mass
 * @property {Shown} balance
 * @property {Shown} swing_weight
 * @property {Shown} drop            ounces less inches
 * @property {Shown} widest          largest diameter
 * @property {string[]} fixtures     what is fixed to the bat and what holds it, before its edits
 * @property {string[]} edits        one for each edit of the file, in their order
 * @property {string[]} warnings
 */

/**
 * A bending mode. `note` is the nearest note and by how many cents it is off: "F3 +12".
 * @typedef {{ order: number, frequency: Shown, note: string, nodes: Place[] }} ModeShown
 */

/**
 * The hit along the barrel: null where ball and bat do not meet. `stiff_m_s`, if the bat did not bend, in `sure` alone.
 * @typedef {{ x_m: number[], exit_m_s: (number | null)[], stiff_m_s?: (number | null)[],
 *             vibration_j: (number | null)[] }} Curve
 */

/**
 * `live` and `sure`: how it rings and hits. `live` is a preview (10 modes to 1e-3, 21 places or more, the wall of a
 * hollow barrel a spring by estimate); `sure` is what `sweetspot hit` answers, and its texts are equal.
 * @typedef {object} Hit
 * @property {number} id
 * @property {boolean} certified     `sure` alone, and only if the accuracy asked for was reached
 * @property {string | null} unmet   why it was not reached, in words
 * @property {boolean} rough_wall    whether a wall that gives way is taken as a spring by estimate
 * @property {ModeShown[]} modes     the first three
 * @property {Curve} curve
 * @property {{ place: Place, speed: Shown } | null} best  the sweet spot by the fastest ball
 * @property {[Place, Place] | null} zone  within 1 % of it
 * @property {Shown | null} vibration  left in vibration at the sweet spot
 * @property {{ what: string, place: Place }[]} spots     every definition of the sweet spot (`sure`)
 * @property {string[]} doubts       what limits trust (`sure`)
 */

/**
 * `analyze` (asks also `diameter_deviation_m`, that of traced diameters): the answers of `sweetspot analyze` with how far the bat in hand may be off in two of three cases; with the
 * wall of a hollow barrel. Slow: a second for wood, several for a hollow bat.
 * @typedef {object} Analyzed
 * @property {number} id
 * @property {{ what: string, value: Shown, open: string, by: string }[]} answers  the lines of its table
 * @property {{ what: string, text: string }[]} figures   as `hit --full` lists them
 * @property {string | null} why     why the sweet spot is there
 * @property {string[]} trust        how far to trust it, in sentences
 * @property {{ hoop: { frequency: Shown, note: string }[], words: string[] } | null} barrel  of a hollow bat
 */

/**
 * `lathe`: what a millimetre off the diameter (1/32 in) does, band by band along the bat, by its derivative.
 * @typedef {object} Lathe
 * @property {number} id
 * @property {string} depth          what is taken off: "mm" or "1/32 in"
 * @property {{ from_m: number, to_m: number }[]} bands
 * @property {{ what: string, changes: (Shown | null)[] }[]} effects  a change for every band
 * @property {string[]} strongest    in sentences
 */

/**
 * `sound` asks also `x_m`, `blow` ("tap": a knock, "finger": soft, "ball": the scene's hit) and `held` ("free" or
 * "hands": held as a grip holds it). Play `Σ a e^(−d t) sin(2π f t) / loudest_m_s2`: a place on a node is quieter.
 * @typedef {object} Sound
 * @property {number} id
 * @property {{ frequency_hz: number, decay_1_s: number, amplitude_m_s2: number }[]} tones
 * @property {number} loudest_m_s2   of such blows anywhere on the barrel
 * @property {string | null} assumed  what is assumed of the damping, in words
 */

/**
 * `tap` asks also `name`, `rate_hz`, `channels` and how many pieces were `lost` of a sound whose samples stand behind the
 * request after a byte 0: channel after channel, four bytes each, the lowest first. The loudest channel is heard. Modes
 * that a person says are in `told`: pairs of a tone's frequency (Hz) and its bending mode, or null for no mode.
 * @typedef {object} Tapped
 * @property {number} id
 * @property {object} document       as `sweetspot tap --json` has it
 * @property {string} heard          taps and rate
 * @property {{ frequency: string, note: string, loss: string, is: string, sure: string,
 *              computed: { frequency: Shown, note: string } | null }[]} tones  the lines of its table
 * @property {string | null} wood    what the bat's material is
 * @property {string[]} words        what spoils it, and what to do
 * @property {string | null} bat_file  the text of the bat of that wood
 * @property {number} most_modes     the highest bending mode that can be said
 */

/**
 * `aim` asks also `targets`, texts as `sweetspot aim --target` takes them ("1 oz lighter", "keep pop", "drop 3",
 * "sweet spot 1 cm outward"), and `remove_only`.
 * @typedef {object} Aimed
 * @property {number} id
 * @property {boolean} met
 * @property {string} bat_file       the text of the new bat's file, its profile as {@link BatFile} has it
 * @property {string} text           what changed, what it costs, and what cannot be had together
 */

/**
 * `files` asks also `name`, that of the bat file on disk (default bat.json).
 * @typedef {object} Files
 * @property {number} id
 * @property {string} bat_file       the text of the bat file
 * @property {string} csv            the stations as a table
 * @property {string[]} template     pages in true size, SVG (A4 for millimetres, letter for inches)
 * @property {string} command        the line that prints the same numbers
 */

/**
 * `trace` has no `bat`; it asks `width` and `height` of a picture whose RGBA bytes stand behind the request after a byte
 * 0, `length_m`, `diameter_m` (the largest), `material`, `pins` (places on its edges set by hand, px), `others` (what
 * other pictures said in `seen`), and where they are known `mass_kg` and `distance_m`.
 * @typedef {object} Traced
 * @property {number} id
 * @property {object} seen           what this picture says
 * @property {number[][][]} edges    two lines of places (px)
 * @property {number[][]} ends       the two ends (px)
 * @property {string} bat_file       of the mean of all pictures
 * @property {number} stations
 * @property {number} pictures
 * @property {number} diameter_deviation_m  standard deviation of a diameter
 * @property {string} deviation      the same in words
 * @property {string[]} words        what limits trust
 */

export {};
