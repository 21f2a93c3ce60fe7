#error "The component 'timers' is not selected: add `components: [+timers]` to microros.yaml and generate again"
