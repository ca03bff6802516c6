"""The random numbers of the program, made again: ChaCha with 8 rounds, uniform numbers, normal ones by the polar method.

Everything here follows the published algorithms (Bernstein, "ChaCha, a variant of Salsa20", 2008; Marsaglia & Bray, SIAM
Review 6, 1964) and what src/sampling/random.rs states of seeds, purposes and streams. Many streams are made at once, one a
row.
"""
import numpy as np

PILOT, CHAIN, REJECTION, DISPLAY, IMPORTANCE, QUANTILE, EXPERIMENT, SPECIFICITY, PERMUTATION, SUBSAMPLE, REACH = range(1, 12)


def _key(seed):
    """32 bytes from a 64-bit seed, by PCG32 (rand_core's seed_from_u64)."""
    state, words, whole = seed, [], (1 << 64) - 1
    for _ in range(8):
        state = (state * 6364136223846793005 + 11634580027462260723) & whole
        word = (((state >> 18) ^ state) >> 27) & 0xFFFFFFFF
        turn = state >> 59
        words.append(((word >> turn) | (word << (32 - turn))) & 0xFFFFFFFF)
    return words


def _turn(x, by):
    return (x << np.uint32(by)) | (x >> np.uint32(32 - by))


def _quarter(s, a, b, c, d):
    s[a] = s[a] + s[b]
    s[d] = _turn(s[d] ^ s[a], 16)
    s[c] = s[c] + s[d]
    s[b] = _turn(s[b] ^ s[c], 12)
    s[a] = s[a] + s[b]
    s[d] = _turn(s[d] ^ s[a], 8)
    s[c] = s[c] + s[d]
    s[b] = _turn(s[b] ^ s[c], 7)


def _words(seed, streams, blocks):
    """The first 16 * blocks words of each stream (streams x words)."""
    streams = np.asarray(streams, np.uint64)
    shape = (len(streams), blocks)
    start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574] + _key(seed)
    state = [np.full(shape, word, np.uint32) for word in start]
    state.append(np.broadcast_to(np.arange(blocks, dtype=np.uint32), shape).copy())
    state.append(np.zeros(shape, np.uint32))
    for shift in (0, 32):
        half = ((streams >> np.uint64(shift)) & np.uint64(0xFFFFFFFF)).astype(np.uint32)
        state.append(np.broadcast_to(half[:, None], shape).copy())
    first = list(state)
    for _ in range(4):
        for column in range(4):
            _quarter(state, column, 4 + column, 8 + column, 12 + column)
        for column in range(4):
            _quarter(state, column, 4 + (column + 1) % 4, 8 + (column + 2) % 4, 12 + (column + 3) % 4)
    return np.stack([x + y for x, y in zip(state, first)], axis=-1).reshape(len(streams), -1)


def uniforms(seed, purpose, side, indices, count):
    """`count` numbers in [0, 1) of each stream (indices x count)."""
    streams = [(purpose << 56) | (side << 48) | int(index) for index in indices]
    words = _words(seed, streams, -(-2 * count // 16)).astype(np.uint64)
    pairs = words.reshape(len(streams), -1, 2)[:, :count]
    return ((pairs[..., 0] | (pairs[..., 1] << np.uint64(32))) >> np.uint64(11)) * (1.0 / (1 << 53))


def normals(seed, purpose, side, indices, count, then=0):
    """`count` normal numbers of each stream (indices x count), and `then` uniform ones that follow them."""
    pairs = -(-count // 2)
    drawn = uniforms(seed, purpose, side, indices, int(2 * pairs * 1.35) + 64 + then)
    values, after = [], []
    for row in drawn:
        x, y = (2 * row[: len(row) // 2 * 2].reshape(-1, 2) - 1).T
        square = x * x + y * y
        places = np.flatnonzero((square < 1) & (square > 0))[:pairs]
        assert len(places) == pairs, "too few uniform numbers were made"
        x, y, square = x[places], y[places], square[places]
        factor = np.sqrt(-2 * np.log(square) / square)
        values.append(np.stack([x * factor, y * factor], axis=1).reshape(-1)[:count])
        used = 2 * (places[-1] + 1)
        after.append(row[used : used + then])
    return np.array(values), np.array(after)


def shuffled(chances, total, first):
    """The first places of numbers 0 ... total - 1, shuffled by rows of uniform numbers (Fisher & Yates)."""
    places = np.tile(np.arange(total), (len(chances), 1))
    rows = np.arange(len(chances))
    for place in range(min(first, total)):
        other = np.minimum(place + (chances[:, place] * (total - place)).astype(int), total - 1)
        places[rows, place], places[rows, other] = places[rows, other], places[rows, place]
    return places
