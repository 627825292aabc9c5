"""How far what moves may go in a tick at once, as a share of its least half side: the numbers of `lanes/strides`."""

SWIFT_SHARE, STRIDE_SHARE = 0.75, 0.5  # beyond which a tick is made in strides, and how far one of these may go
MOST_STRIDES = 100  # in one tick; what time is left then is lost
