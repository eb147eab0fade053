"""The checksum of a frame: CRC-16 with polynomial x^16 + x^12 + x^5 + 1, as CRC-16/CCITT-FALSE has it.

Initial value 0xFFFF, no reflection, no final xor: the checksum of ``b"123456789"`` is 0x29B1.  It finds every
error of one or two bits in up to 32 751 bits, every odd number of wrong bits and every burst of up to 16 bits
[W. Peterson, D. Brown, Cyclic Codes for Error Detection, 1961].
"""

POLYNOMIAL = 0x1021
INITIAL = 0xFFFF


def _remainder(byte: int) -> int:
    """What one byte leaves behind when it is shifted through an empty register."""
    register = byte << 8
    for _ in range(8):
        register = (register << 1) ^ (POLYNOMIAL if register & 0x8000 else 0)
    return register & 0xFFFF


_REMAINDERS = tuple(map(_remainder, range(256)))


def crc16(data: bytes) -> int:
    """The checksum of ``data``, 0 to 0xFFFF; 0 if ``data`` ends in its own checksum, high byte first."""
    register = INITIAL
    for byte in data:
        register = (register << 8) & 0xFFFF ^ _REMAINDERS[register >> 8 ^ byte]
    return register
