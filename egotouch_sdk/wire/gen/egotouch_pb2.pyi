from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class EventType(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    EVENT_TYPE_UNSPECIFIED: _ClassVar[EventType]
    EVENT_TYPE_HOVER_ENTER: _ClassVar[EventType]
    EVENT_TYPE_HOVER_MOVE: _ClassVar[EventType]
    EVENT_TYPE_HOVER_EXIT: _ClassVar[EventType]
    EVENT_TYPE_DOWN: _ClassVar[EventType]
    EVENT_TYPE_MOVE: _ClassVar[EventType]
    EVENT_TYPE_UP: _ClassVar[EventType]
    EVENT_TYPE_CANCEL: _ClassVar[EventType]
    EVENT_TYPE_CLICK: _ClassVar[EventType]
    EVENT_TYPE_DOUBLE_CLICK: _ClassVar[EventType]
    EVENT_TYPE_LONG_CLICK: _ClassVar[EventType]
    EVENT_TYPE_DRAG_START: _ClassVar[EventType]
    EVENT_TYPE_DRAG: _ClassVar[EventType]
    EVENT_TYPE_DRAG_END: _ClassVar[EventType]
    EVENT_TYPE_FORCE_ENTER: _ClassVar[EventType]
    EVENT_TYPE_FORCE_CHANGE: _ClassVar[EventType]
    EVENT_TYPE_FORCE_EXIT: _ClassVar[EventType]
    EVENT_TYPE_FLING: _ClassVar[EventType]

class Finger(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    FINGER_UNSPECIFIED: _ClassVar[Finger]
    FINGER_THUMB: _ClassVar[Finger]
    FINGER_INDEX: _ClassVar[Finger]
    FINGER_MIDDLE: _ClassVar[Finger]
    FINGER_RING: _ClassVar[Finger]
    FINGER_PINKY: _ClassVar[Finger]

class Handedness(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    HANDEDNESS_UNSPECIFIED: _ClassVar[Handedness]
    HANDEDNESS_LEFT: _ClassVar[Handedness]
    HANDEDNESS_RIGHT: _ClassVar[Handedness]

class Surface(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    SURFACE_UNSPECIFIED: _ClassVar[Surface]
    SURFACE_PALM: _ClassVar[Surface]
    SURFACE_BACK_OF_HAND: _ClassVar[Surface]
    SURFACE_INNER_FOREARM: _ClassVar[Surface]
    SURFACE_OUTER_FOREARM: _ClassVar[Surface]

class CancelReason(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    CANCEL_REASON_UNSPECIFIED: _ClassVar[CancelReason]
    CANCEL_REASON_TRACKING_LOST: _ClassVar[CancelReason]
    CANCEL_REASON_HAND_SWAPPED: _ClassVar[CancelReason]
    CANCEL_REASON_SOURCE_STALLED: _ClassVar[CancelReason]
    CANCEL_REASON_SOURCE_ENDED: _ClassVar[CancelReason]
    CANCEL_REASON_DISCONNECTED: _ClassVar[CancelReason]
    CANCEL_REASON_SERVER_STOPPED: _ClassVar[CancelReason]

class GateReason(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    GATE_REASON_UNSPECIFIED: _ClassVar[GateReason]
    GATE_REASON_OPEN: _ClassVar[GateReason]
    GATE_REASON_NO_HANDS: _ClassVar[GateReason]
    GATE_REASON_NO_HOST: _ClassVar[GateReason]
    GATE_REASON_TOO_FAR: _ClassVar[GateReason]
    GATE_REASON_NO_ACTIVE_FINGER: _ClassVar[GateReason]
EVENT_TYPE_UNSPECIFIED: EventType
EVENT_TYPE_HOVER_ENTER: EventType
EVENT_TYPE_HOVER_MOVE: EventType
EVENT_TYPE_HOVER_EXIT: EventType
EVENT_TYPE_DOWN: EventType
EVENT_TYPE_MOVE: EventType
EVENT_TYPE_UP: EventType
EVENT_TYPE_CANCEL: EventType
EVENT_TYPE_CLICK: EventType
EVENT_TYPE_DOUBLE_CLICK: EventType
EVENT_TYPE_LONG_CLICK: EventType
EVENT_TYPE_DRAG_START: EventType
EVENT_TYPE_DRAG: EventType
EVENT_TYPE_DRAG_END: EventType
EVENT_TYPE_FORCE_ENTER: EventType
EVENT_TYPE_FORCE_CHANGE: EventType
EVENT_TYPE_FORCE_EXIT: EventType
EVENT_TYPE_FLING: EventType
FINGER_UNSPECIFIED: Finger
FINGER_THUMB: Finger
FINGER_INDEX: Finger
FINGER_MIDDLE: Finger
FINGER_RING: Finger
FINGER_PINKY: Finger
HANDEDNESS_UNSPECIFIED: Handedness
HANDEDNESS_LEFT: Handedness
HANDEDNESS_RIGHT: Handedness
SURFACE_UNSPECIFIED: Surface
SURFACE_PALM: Surface
SURFACE_BACK_OF_HAND: Surface
SURFACE_INNER_FOREARM: Surface
SURFACE_OUTER_FOREARM: Surface
CANCEL_REASON_UNSPECIFIED: CancelReason
CANCEL_REASON_TRACKING_LOST: CancelReason
CANCEL_REASON_HAND_SWAPPED: CancelReason
CANCEL_REASON_SOURCE_STALLED: CancelReason
CANCEL_REASON_SOURCE_ENDED: CancelReason
CANCEL_REASON_DISCONNECTED: CancelReason
CANCEL_REASON_SERVER_STOPPED: CancelReason
GATE_REASON_UNSPECIFIED: GateReason
GATE_REASON_OPEN: GateReason
GATE_REASON_NO_HANDS: GateReason
GATE_REASON_NO_HOST: GateReason
GATE_REASON_TOO_FAR: GateReason
GATE_REASON_NO_ACTIVE_FINGER: GateReason

class TouchEvent(_message.Message):
    __slots__ = ("type", "pointer_id", "contact_id", "timestamp_ns", "down_time_ns", "hand", "finger", "surface", "touch_probability", "force_n", "force_sigma_n", "x_mm", "y_mm", "dx_mm", "dy_mm", "velocity_x_mm_s", "velocity_y_mm_s", "pitch_rad", "yaw_rad", "image_x", "image_y", "click_count", "reason", "coalesced")
    TYPE_FIELD_NUMBER: _ClassVar[int]
    POINTER_ID_FIELD_NUMBER: _ClassVar[int]
    CONTACT_ID_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    DOWN_TIME_NS_FIELD_NUMBER: _ClassVar[int]
    HAND_FIELD_NUMBER: _ClassVar[int]
    FINGER_FIELD_NUMBER: _ClassVar[int]
    SURFACE_FIELD_NUMBER: _ClassVar[int]
    TOUCH_PROBABILITY_FIELD_NUMBER: _ClassVar[int]
    FORCE_N_FIELD_NUMBER: _ClassVar[int]
    FORCE_SIGMA_N_FIELD_NUMBER: _ClassVar[int]
    X_MM_FIELD_NUMBER: _ClassVar[int]
    Y_MM_FIELD_NUMBER: _ClassVar[int]
    DX_MM_FIELD_NUMBER: _ClassVar[int]
    DY_MM_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_X_MM_S_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_Y_MM_S_FIELD_NUMBER: _ClassVar[int]
    PITCH_RAD_FIELD_NUMBER: _ClassVar[int]
    YAW_RAD_FIELD_NUMBER: _ClassVar[int]
    IMAGE_X_FIELD_NUMBER: _ClassVar[int]
    IMAGE_Y_FIELD_NUMBER: _ClassVar[int]
    CLICK_COUNT_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    COALESCED_FIELD_NUMBER: _ClassVar[int]
    type: EventType
    pointer_id: int
    contact_id: int
    timestamp_ns: int
    down_time_ns: int
    hand: Handedness
    finger: Finger
    surface: Surface
    touch_probability: float
    force_n: float
    force_sigma_n: float
    x_mm: float
    y_mm: float
    dx_mm: float
    dy_mm: float
    velocity_x_mm_s: float
    velocity_y_mm_s: float
    pitch_rad: float
    yaw_rad: float
    image_x: float
    image_y: float
    click_count: int
    reason: CancelReason
    coalesced: _containers.RepeatedCompositeFieldContainer[TouchEvent]
    def __init__(self, type: _Optional[_Union[EventType, str]] = ..., pointer_id: _Optional[int] = ..., contact_id: _Optional[int] = ..., timestamp_ns: _Optional[int] = ..., down_time_ns: _Optional[int] = ..., hand: _Optional[_Union[Handedness, str]] = ..., finger: _Optional[_Union[Finger, str]] = ..., surface: _Optional[_Union[Surface, str]] = ..., touch_probability: _Optional[float] = ..., force_n: _Optional[float] = ..., force_sigma_n: _Optional[float] = ..., x_mm: _Optional[float] = ..., y_mm: _Optional[float] = ..., dx_mm: _Optional[float] = ..., dy_mm: _Optional[float] = ..., velocity_x_mm_s: _Optional[float] = ..., velocity_y_mm_s: _Optional[float] = ..., pitch_rad: _Optional[float] = ..., yaw_rad: _Optional[float] = ..., image_x: _Optional[float] = ..., image_y: _Optional[float] = ..., click_count: _Optional[int] = ..., reason: _Optional[_Union[CancelReason, str]] = ..., coalesced: _Optional[_Iterable[_Union[TouchEvent, _Mapping]]] = ...) -> None: ...

class ClientMessage(_message.Message):
    __slots__ = ("hello", "subscribe", "clock_request", "heartbeat", "frame", "hands", "simulated")
    HELLO_FIELD_NUMBER: _ClassVar[int]
    SUBSCRIBE_FIELD_NUMBER: _ClassVar[int]
    CLOCK_REQUEST_FIELD_NUMBER: _ClassVar[int]
    HEARTBEAT_FIELD_NUMBER: _ClassVar[int]
    FRAME_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    SIMULATED_FIELD_NUMBER: _ClassVar[int]
    hello: Hello
    subscribe: Subscribe
    clock_request: ClockRequest
    heartbeat: Heartbeat
    frame: ClientFrame
    hands: ClientHands
    simulated: SimulatedPointers
    def __init__(self, hello: _Optional[_Union[Hello, _Mapping]] = ..., subscribe: _Optional[_Union[Subscribe, _Mapping]] = ..., clock_request: _Optional[_Union[ClockRequest, _Mapping]] = ..., heartbeat: _Optional[_Union[Heartbeat, _Mapping]] = ..., frame: _Optional[_Union[ClientFrame, _Mapping]] = ..., hands: _Optional[_Union[ClientHands, _Mapping]] = ..., simulated: _Optional[_Union[SimulatedPointers, _Mapping]] = ...) -> None: ...

class Hello(_message.Message):
    __slots__ = ("client", "version", "protocol_minor", "token", "pairing_code", "resume", "features", "subscribe")
    CLIENT_FIELD_NUMBER: _ClassVar[int]
    VERSION_FIELD_NUMBER: _ClassVar[int]
    PROTOCOL_MINOR_FIELD_NUMBER: _ClassVar[int]
    TOKEN_FIELD_NUMBER: _ClassVar[int]
    PAIRING_CODE_FIELD_NUMBER: _ClassVar[int]
    RESUME_FIELD_NUMBER: _ClassVar[int]
    FEATURES_FIELD_NUMBER: _ClassVar[int]
    SUBSCRIBE_FIELD_NUMBER: _ClassVar[int]
    client: str
    version: str
    protocol_minor: int
    token: str
    pairing_code: str
    resume: Resume
    features: _containers.RepeatedScalarFieldContainer[str]
    subscribe: Subscribe
    def __init__(self, client: _Optional[str] = ..., version: _Optional[str] = ..., protocol_minor: _Optional[int] = ..., token: _Optional[str] = ..., pairing_code: _Optional[str] = ..., resume: _Optional[_Union[Resume, _Mapping]] = ..., features: _Optional[_Iterable[str]] = ..., subscribe: _Optional[_Union[Subscribe, _Mapping]] = ...) -> None: ...

class Resume(_message.Message):
    __slots__ = ("epoch", "offset", "held")
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    OFFSET_FIELD_NUMBER: _ClassVar[int]
    HELD_FIELD_NUMBER: _ClassVar[int]
    epoch: int
    offset: int
    held: _containers.RepeatedCompositeFieldContainer[HeldPointer]
    def __init__(self, epoch: _Optional[int] = ..., offset: _Optional[int] = ..., held: _Optional[_Iterable[_Union[HeldPointer, _Mapping]]] = ...) -> None: ...

class HeldPointer(_message.Message):
    __slots__ = ("pointer_id", "contact_id", "dragging", "pressing")
    POINTER_ID_FIELD_NUMBER: _ClassVar[int]
    CONTACT_ID_FIELD_NUMBER: _ClassVar[int]
    DRAGGING_FIELD_NUMBER: _ClassVar[int]
    PRESSING_FIELD_NUMBER: _ClassVar[int]
    pointer_id: int
    contact_id: int
    dragging: bool
    pressing: bool
    def __init__(self, pointer_id: _Optional[int] = ..., contact_id: _Optional[int] = ..., dragging: bool = ..., pressing: bool = ...) -> None: ...

class Subscribe(_message.Message):
    __slots__ = ("types", "fingers", "hands", "surfaces", "max_rate_hz", "latest_only", "status", "late_edges", "landmarks")
    TYPES_FIELD_NUMBER: _ClassVar[int]
    FINGERS_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    SURFACES_FIELD_NUMBER: _ClassVar[int]
    MAX_RATE_HZ_FIELD_NUMBER: _ClassVar[int]
    LATEST_ONLY_FIELD_NUMBER: _ClassVar[int]
    STATUS_FIELD_NUMBER: _ClassVar[int]
    LATE_EDGES_FIELD_NUMBER: _ClassVar[int]
    LANDMARKS_FIELD_NUMBER: _ClassVar[int]
    types: _containers.RepeatedScalarFieldContainer[EventType]
    fingers: _containers.RepeatedScalarFieldContainer[Finger]
    hands: _containers.RepeatedScalarFieldContainer[Handedness]
    surfaces: _containers.RepeatedScalarFieldContainer[Surface]
    max_rate_hz: float
    latest_only: bool
    status: bool
    late_edges: bool
    landmarks: bool
    def __init__(self, types: _Optional[_Iterable[_Union[EventType, str]]] = ..., fingers: _Optional[_Iterable[_Union[Finger, str]]] = ..., hands: _Optional[_Iterable[_Union[Handedness, str]]] = ..., surfaces: _Optional[_Iterable[_Union[Surface, str]]] = ..., max_rate_hz: _Optional[float] = ..., latest_only: bool = ..., status: bool = ..., late_edges: bool = ..., landmarks: bool = ...) -> None: ...

class ClockRequest(_message.Message):
    __slots__ = ("client_send_ns",)
    CLIENT_SEND_NS_FIELD_NUMBER: _ClassVar[int]
    client_send_ns: int
    def __init__(self, client_send_ns: _Optional[int] = ...) -> None: ...

class ClientFrame(_message.Message):
    __slots__ = ("jpeg", "timestamp_ns")
    JPEG_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    jpeg: bytes
    timestamp_ns: int
    def __init__(self, jpeg: _Optional[bytes] = ..., timestamp_ns: _Optional[int] = ...) -> None: ...

class ClientHands(_message.Message):
    __slots__ = ("timestamp_ns", "hands")
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    timestamp_ns: int
    hands: _containers.RepeatedCompositeFieldContainer[Hand]
    def __init__(self, timestamp_ns: _Optional[int] = ..., hands: _Optional[_Iterable[_Union[Hand, _Mapping]]] = ...) -> None: ...

class SimulatedPointers(_message.Message):
    __slots__ = ("pointers",)
    POINTERS_FIELD_NUMBER: _ClassVar[int]
    pointers: _containers.RepeatedCompositeFieldContainer[SimulatedPointer]
    def __init__(self, pointers: _Optional[_Iterable[_Union[SimulatedPointer, _Mapping]]] = ...) -> None: ...

class SimulatedPointer(_message.Message):
    __slots__ = ("id", "hand", "finger", "surface", "x_mm", "y_mm", "hover_mm", "force_n", "pitch_rad", "yaw_rad")
    ID_FIELD_NUMBER: _ClassVar[int]
    HAND_FIELD_NUMBER: _ClassVar[int]
    FINGER_FIELD_NUMBER: _ClassVar[int]
    SURFACE_FIELD_NUMBER: _ClassVar[int]
    X_MM_FIELD_NUMBER: _ClassVar[int]
    Y_MM_FIELD_NUMBER: _ClassVar[int]
    HOVER_MM_FIELD_NUMBER: _ClassVar[int]
    FORCE_N_FIELD_NUMBER: _ClassVar[int]
    PITCH_RAD_FIELD_NUMBER: _ClassVar[int]
    YAW_RAD_FIELD_NUMBER: _ClassVar[int]
    id: int
    hand: Handedness
    finger: Finger
    surface: Surface
    x_mm: float
    y_mm: float
    hover_mm: float
    force_n: float
    pitch_rad: float
    yaw_rad: float
    def __init__(self, id: _Optional[int] = ..., hand: _Optional[_Union[Handedness, str]] = ..., finger: _Optional[_Union[Finger, str]] = ..., surface: _Optional[_Union[Surface, str]] = ..., x_mm: _Optional[float] = ..., y_mm: _Optional[float] = ..., hover_mm: _Optional[float] = ..., force_n: _Optional[float] = ..., pitch_rad: _Optional[float] = ..., yaw_rad: _Optional[float] = ...) -> None: ...

class ServerMessage(_message.Message):
    __slots__ = ("offset", "welcome", "batch", "snapshot", "heartbeat", "clock_reply", "warning", "status", "hands")
    OFFSET_FIELD_NUMBER: _ClassVar[int]
    WELCOME_FIELD_NUMBER: _ClassVar[int]
    BATCH_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    HEARTBEAT_FIELD_NUMBER: _ClassVar[int]
    CLOCK_REPLY_FIELD_NUMBER: _ClassVar[int]
    WARNING_FIELD_NUMBER: _ClassVar[int]
    STATUS_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    offset: int
    welcome: Welcome
    batch: EventBatch
    snapshot: Snapshot
    heartbeat: Heartbeat
    clock_reply: ClockReply
    warning: Warning
    status: Status
    hands: HandsView
    def __init__(self, offset: _Optional[int] = ..., welcome: _Optional[_Union[Welcome, _Mapping]] = ..., batch: _Optional[_Union[EventBatch, _Mapping]] = ..., snapshot: _Optional[_Union[Snapshot, _Mapping]] = ..., heartbeat: _Optional[_Union[Heartbeat, _Mapping]] = ..., clock_reply: _Optional[_Union[ClockReply, _Mapping]] = ..., warning: _Optional[_Union[Warning, _Mapping]] = ..., status: _Optional[_Union[Status, _Mapping]] = ..., hands: _Optional[_Union[HandsView, _Mapping]] = ...) -> None: ...

class Welcome(_message.Message):
    __slots__ = ("epoch", "recovered", "resume_requested", "protocol_minor", "server_version", "heartbeat_ms", "active_heartbeat_ms", "input_ttl_ms", "features", "settings", "snapshot", "server_now_ns", "token")
    EPOCH_FIELD_NUMBER: _ClassVar[int]
    RECOVERED_FIELD_NUMBER: _ClassVar[int]
    RESUME_REQUESTED_FIELD_NUMBER: _ClassVar[int]
    PROTOCOL_MINOR_FIELD_NUMBER: _ClassVar[int]
    SERVER_VERSION_FIELD_NUMBER: _ClassVar[int]
    HEARTBEAT_MS_FIELD_NUMBER: _ClassVar[int]
    ACTIVE_HEARTBEAT_MS_FIELD_NUMBER: _ClassVar[int]
    INPUT_TTL_MS_FIELD_NUMBER: _ClassVar[int]
    FEATURES_FIELD_NUMBER: _ClassVar[int]
    SETTINGS_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    SERVER_NOW_NS_FIELD_NUMBER: _ClassVar[int]
    TOKEN_FIELD_NUMBER: _ClassVar[int]
    epoch: int
    recovered: bool
    resume_requested: bool
    protocol_minor: int
    server_version: str
    heartbeat_ms: int
    active_heartbeat_ms: int
    input_ttl_ms: int
    features: _containers.RepeatedScalarFieldContainer[str]
    settings: GestureSettings
    snapshot: Snapshot
    server_now_ns: int
    token: str
    def __init__(self, epoch: _Optional[int] = ..., recovered: bool = ..., resume_requested: bool = ..., protocol_minor: _Optional[int] = ..., server_version: _Optional[str] = ..., heartbeat_ms: _Optional[int] = ..., active_heartbeat_ms: _Optional[int] = ..., input_ttl_ms: _Optional[int] = ..., features: _Optional[_Iterable[str]] = ..., settings: _Optional[_Union[GestureSettings, _Mapping]] = ..., snapshot: _Optional[_Union[Snapshot, _Mapping]] = ..., server_now_ns: _Optional[int] = ..., token: _Optional[str] = ...) -> None: ...

class GestureSettings(_message.Message):
    __slots__ = ("touch_slop_mm", "double_click_slop_mm", "long_press_timeout_ms", "double_tap_timeout_ms", "force_enter_n", "force_exit_n", "force_max_n")
    TOUCH_SLOP_MM_FIELD_NUMBER: _ClassVar[int]
    DOUBLE_CLICK_SLOP_MM_FIELD_NUMBER: _ClassVar[int]
    LONG_PRESS_TIMEOUT_MS_FIELD_NUMBER: _ClassVar[int]
    DOUBLE_TAP_TIMEOUT_MS_FIELD_NUMBER: _ClassVar[int]
    FORCE_ENTER_N_FIELD_NUMBER: _ClassVar[int]
    FORCE_EXIT_N_FIELD_NUMBER: _ClassVar[int]
    FORCE_MAX_N_FIELD_NUMBER: _ClassVar[int]
    touch_slop_mm: float
    double_click_slop_mm: float
    long_press_timeout_ms: float
    double_tap_timeout_ms: float
    force_enter_n: float
    force_exit_n: float
    force_max_n: float
    def __init__(self, touch_slop_mm: _Optional[float] = ..., double_click_slop_mm: _Optional[float] = ..., long_press_timeout_ms: _Optional[float] = ..., double_tap_timeout_ms: _Optional[float] = ..., force_enter_n: _Optional[float] = ..., force_exit_n: _Optional[float] = ..., force_max_n: _Optional[float] = ...) -> None: ...

class EventBatch(_message.Message):
    __slots__ = ("frame_index", "timestamp_ns", "sent_ns", "events", "late")
    FRAME_INDEX_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    SENT_NS_FIELD_NUMBER: _ClassVar[int]
    EVENTS_FIELD_NUMBER: _ClassVar[int]
    LATE_FIELD_NUMBER: _ClassVar[int]
    frame_index: int
    timestamp_ns: int
    sent_ns: int
    events: _containers.RepeatedCompositeFieldContainer[TouchEvent]
    late: bool
    def __init__(self, frame_index: _Optional[int] = ..., timestamp_ns: _Optional[int] = ..., sent_ns: _Optional[int] = ..., events: _Optional[_Iterable[_Union[TouchEvent, _Mapping]]] = ..., late: bool = ...) -> None: ...

class Snapshot(_message.Message):
    __slots__ = ("pointers",)
    POINTERS_FIELD_NUMBER: _ClassVar[int]
    pointers: _containers.RepeatedCompositeFieldContainer[TouchEvent]
    def __init__(self, pointers: _Optional[_Iterable[_Union[TouchEvent, _Mapping]]] = ...) -> None: ...

class Heartbeat(_message.Message):
    __slots__ = ("sent_ns", "active_contacts")
    SENT_NS_FIELD_NUMBER: _ClassVar[int]
    ACTIVE_CONTACTS_FIELD_NUMBER: _ClassVar[int]
    sent_ns: int
    active_contacts: int
    def __init__(self, sent_ns: _Optional[int] = ..., active_contacts: _Optional[int] = ...) -> None: ...

class ClockReply(_message.Message):
    __slots__ = ("client_send_ns", "server_receive_ns", "server_send_ns")
    CLIENT_SEND_NS_FIELD_NUMBER: _ClassVar[int]
    SERVER_RECEIVE_NS_FIELD_NUMBER: _ClassVar[int]
    SERVER_SEND_NS_FIELD_NUMBER: _ClassVar[int]
    client_send_ns: int
    server_receive_ns: int
    server_send_ns: int
    def __init__(self, client_send_ns: _Optional[int] = ..., server_receive_ns: _Optional[int] = ..., server_send_ns: _Optional[int] = ...) -> None: ...

class Warning(_message.Message):
    __slots__ = ("code", "message")
    CODE_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_FIELD_NUMBER: _ClassVar[int]
    code: str
    message: str
    def __init__(self, code: _Optional[str] = ..., message: _Optional[str] = ...) -> None: ...

class Status(_message.Message):
    __slots__ = ("fps", "capture_to_send_p50_ms", "capture_to_send_p95_ms", "hands_in_view", "gate", "merged", "source")
    FPS_FIELD_NUMBER: _ClassVar[int]
    CAPTURE_TO_SEND_P50_MS_FIELD_NUMBER: _ClassVar[int]
    CAPTURE_TO_SEND_P95_MS_FIELD_NUMBER: _ClassVar[int]
    HANDS_IN_VIEW_FIELD_NUMBER: _ClassVar[int]
    GATE_FIELD_NUMBER: _ClassVar[int]
    MERGED_FIELD_NUMBER: _ClassVar[int]
    SOURCE_FIELD_NUMBER: _ClassVar[int]
    fps: float
    capture_to_send_p50_ms: float
    capture_to_send_p95_ms: float
    hands_in_view: int
    gate: GateReason
    merged: int
    source: str
    def __init__(self, fps: _Optional[float] = ..., capture_to_send_p50_ms: _Optional[float] = ..., capture_to_send_p95_ms: _Optional[float] = ..., hands_in_view: _Optional[int] = ..., gate: _Optional[_Union[GateReason, str]] = ..., merged: _Optional[int] = ..., source: _Optional[str] = ...) -> None: ...

class HandsView(_message.Message):
    __slots__ = ("timestamp_ns", "width_px", "height_px", "hands")
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    WIDTH_PX_FIELD_NUMBER: _ClassVar[int]
    HEIGHT_PX_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    timestamp_ns: int
    width_px: int
    height_px: int
    hands: _containers.RepeatedCompositeFieldContainer[Hand]
    def __init__(self, timestamp_ns: _Optional[int] = ..., width_px: _Optional[int] = ..., height_px: _Optional[int] = ..., hands: _Optional[_Iterable[_Union[Hand, _Mapping]]] = ...) -> None: ...

class Hand(_message.Message):
    __slots__ = ("hand_id", "handedness", "score", "landmarks_px", "world_mm")
    HAND_ID_FIELD_NUMBER: _ClassVar[int]
    HANDEDNESS_FIELD_NUMBER: _ClassVar[int]
    SCORE_FIELD_NUMBER: _ClassVar[int]
    LANDMARKS_PX_FIELD_NUMBER: _ClassVar[int]
    WORLD_MM_FIELD_NUMBER: _ClassVar[int]
    hand_id: int
    handedness: Handedness
    score: float
    landmarks_px: _containers.RepeatedScalarFieldContainer[float]
    world_mm: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, hand_id: _Optional[int] = ..., handedness: _Optional[_Union[Handedness, str]] = ..., score: _Optional[float] = ..., landmarks_px: _Optional[_Iterable[float]] = ..., world_mm: _Optional[_Iterable[float]] = ...) -> None: ...

class TouchPair(_message.Message):
    __slots__ = ("touching", "host", "distance_palms", "active_fingers")
    TOUCHING_FIELD_NUMBER: _ClassVar[int]
    HOST_FIELD_NUMBER: _ClassVar[int]
    DISTANCE_PALMS_FIELD_NUMBER: _ClassVar[int]
    ACTIVE_FINGERS_FIELD_NUMBER: _ClassVar[int]
    touching: Hand
    host: Hand
    distance_palms: float
    active_fingers: _containers.RepeatedScalarFieldContainer[Finger]
    def __init__(self, touching: _Optional[_Union[Hand, _Mapping]] = ..., host: _Optional[_Union[Hand, _Mapping]] = ..., distance_palms: _Optional[float] = ..., active_fingers: _Optional[_Iterable[_Union[Finger, str]]] = ...) -> None: ...

class Fingertip(_message.Message):
    __slots__ = ("hand_id", "handedness", "finger", "tip_x_px", "tip_y_px", "px_per_mm", "r_palms", "theta_rad", "touch_probability", "force_n", "force_sigma_n")
    HAND_ID_FIELD_NUMBER: _ClassVar[int]
    HANDEDNESS_FIELD_NUMBER: _ClassVar[int]
    FINGER_FIELD_NUMBER: _ClassVar[int]
    TIP_X_PX_FIELD_NUMBER: _ClassVar[int]
    TIP_Y_PX_FIELD_NUMBER: _ClassVar[int]
    PX_PER_MM_FIELD_NUMBER: _ClassVar[int]
    R_PALMS_FIELD_NUMBER: _ClassVar[int]
    THETA_RAD_FIELD_NUMBER: _ClassVar[int]
    TOUCH_PROBABILITY_FIELD_NUMBER: _ClassVar[int]
    FORCE_N_FIELD_NUMBER: _ClassVar[int]
    FORCE_SIGMA_N_FIELD_NUMBER: _ClassVar[int]
    hand_id: int
    handedness: Handedness
    finger: Finger
    tip_x_px: float
    tip_y_px: float
    px_per_mm: float
    r_palms: float
    theta_rad: float
    touch_probability: float
    force_n: float
    force_sigma_n: float
    def __init__(self, hand_id: _Optional[int] = ..., handedness: _Optional[_Union[Handedness, str]] = ..., finger: _Optional[_Union[Finger, str]] = ..., tip_x_px: _Optional[float] = ..., tip_y_px: _Optional[float] = ..., px_per_mm: _Optional[float] = ..., r_palms: _Optional[float] = ..., theta_rad: _Optional[float] = ..., touch_probability: _Optional[float] = ..., force_n: _Optional[float] = ..., force_sigma_n: _Optional[float] = ...) -> None: ...

class FrameObservation(_message.Message):
    __slots__ = ("index", "timestamp_ns", "width_px", "height_px", "hands", "gate", "pairs", "fingertips")
    INDEX_FIELD_NUMBER: _ClassVar[int]
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    WIDTH_PX_FIELD_NUMBER: _ClassVar[int]
    HEIGHT_PX_FIELD_NUMBER: _ClassVar[int]
    HANDS_FIELD_NUMBER: _ClassVar[int]
    GATE_FIELD_NUMBER: _ClassVar[int]
    PAIRS_FIELD_NUMBER: _ClassVar[int]
    FINGERTIPS_FIELD_NUMBER: _ClassVar[int]
    index: int
    timestamp_ns: int
    width_px: int
    height_px: int
    hands: _containers.RepeatedCompositeFieldContainer[Hand]
    gate: GateReason
    pairs: _containers.RepeatedCompositeFieldContainer[TouchPair]
    fingertips: _containers.RepeatedCompositeFieldContainer[Fingertip]
    def __init__(self, index: _Optional[int] = ..., timestamp_ns: _Optional[int] = ..., width_px: _Optional[int] = ..., height_px: _Optional[int] = ..., hands: _Optional[_Iterable[_Union[Hand, _Mapping]]] = ..., gate: _Optional[_Union[GateReason, str]] = ..., pairs: _Optional[_Iterable[_Union[TouchPair, _Mapping]]] = ..., fingertips: _Optional[_Iterable[_Union[Fingertip, _Mapping]]] = ...) -> None: ...

class RecordingHeader(_message.Message):
    __slots__ = ("format", "sdk_version", "config_json", "down_probability", "up_probability", "model_sha256", "source", "fps", "created_unix_ms")
    class ModelSha256Entry(_message.Message):
        __slots__ = ("key", "value")
        KEY_FIELD_NUMBER: _ClassVar[int]
        VALUE_FIELD_NUMBER: _ClassVar[int]
        key: str
        value: str
        def __init__(self, key: _Optional[str] = ..., value: _Optional[str] = ...) -> None: ...
    FORMAT_FIELD_NUMBER: _ClassVar[int]
    SDK_VERSION_FIELD_NUMBER: _ClassVar[int]
    CONFIG_JSON_FIELD_NUMBER: _ClassVar[int]
    DOWN_PROBABILITY_FIELD_NUMBER: _ClassVar[int]
    UP_PROBABILITY_FIELD_NUMBER: _ClassVar[int]
    MODEL_SHA256_FIELD_NUMBER: _ClassVar[int]
    SOURCE_FIELD_NUMBER: _ClassVar[int]
    FPS_FIELD_NUMBER: _ClassVar[int]
    CREATED_UNIX_MS_FIELD_NUMBER: _ClassVar[int]
    format: int
    sdk_version: str
    config_json: str
    down_probability: float
    up_probability: float
    model_sha256: _containers.ScalarMap[str, str]
    source: str
    fps: float
    created_unix_ms: int
    def __init__(self, format: _Optional[int] = ..., sdk_version: _Optional[str] = ..., config_json: _Optional[str] = ..., down_probability: _Optional[float] = ..., up_probability: _Optional[float] = ..., model_sha256: _Optional[_Mapping[str, str]] = ..., source: _Optional[str] = ..., fps: _Optional[float] = ..., created_unix_ms: _Optional[int] = ...) -> None: ...

class RecordedEvents(_message.Message):
    __slots__ = ("timestamp_ns", "events")
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    EVENTS_FIELD_NUMBER: _ClassVar[int]
    timestamp_ns: int
    events: _containers.RepeatedCompositeFieldContainer[TouchEvent]
    def __init__(self, timestamp_ns: _Optional[int] = ..., events: _Optional[_Iterable[_Union[TouchEvent, _Mapping]]] = ...) -> None: ...

class RecordingEnd(_message.Message):
    __slots__ = ("timestamp_ns", "reason")
    TIMESTAMP_NS_FIELD_NUMBER: _ClassVar[int]
    REASON_FIELD_NUMBER: _ClassVar[int]
    timestamp_ns: int
    reason: CancelReason
    def __init__(self, timestamp_ns: _Optional[int] = ..., reason: _Optional[_Union[CancelReason, str]] = ...) -> None: ...
