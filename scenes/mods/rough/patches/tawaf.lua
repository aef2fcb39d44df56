return patch "tawaf" {
  states = {
    ToStone = { push = 60 * max(now.speed, own.speed), push_weight = "nearest" },
    Queue = { push = 60 * max(now.speed, own.speed), push_weight = "nearest" },
  },
}
